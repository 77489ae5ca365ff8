"""A stage as the page will see it; number, real-time factor and twin are filled in by the conductor."""

from surefoot.dashboard.live.live_run import Stage
from surefoot.dashboard.messages.snapshot import Snapshot


def picture_of(stage: Stage) -> Snapshot:
    """An immutable picture of the stage as it is now."""
    return Snapshot(
        number=0, run=stage.runs, time_s=stage.simulation.time_s, playing=stage.playing, speed=stage.speed,
        real_time_factor=0.0, scenario=stage.scenario.name, controller=stage.controller,
        support=str(stage.scenario.support), settings=stage.settings, friction=stage.friction, bias=stage.bias,
        geometry=stage.observer.geometry(), verdict=stage.observer.verdict(ended=stage.ended),
        traces=stage.observer.traces(), limits=stage.observer.limits, events=stage.log.events,
        timeline=stage.history.view(), tuning=stage.tuning,
        headroom=stage.observer.headroom(),
    )  # fmt: skip
