"""A live run as the page will see it; number, real-time factor and twin are filled in by the coordinator."""

from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.messages.snapshot import Snapshot


def take_snapshot(live: LiveRun) -> Snapshot:
    """An immutable picture of the live run as it is now."""
    return Snapshot(
        number=0, run=live.runs, time_s=live.simulation.time_s, playing=live.playing, speed=live.speed,
        real_time_factor=0.0, scenario=live.scenario.name, controller=live.controller,
        support=str(live.scenario.support), settings=live.settings, friction=live.friction, bias=live.bias,
        geometry=live.observer.geometry(), verdict=live.observer.verdict(ended=live.ended),
        traces=live.observer.traces(), limits=live.observer.limits, events=live.log.events,
        timeline=live.history.view(), tuning=live.tuning,
        headroom=live.observer.headroom(),
    )  # fmt: skip
