"""Make a saved run again, from its file alone."""

from collections.abc import Callable
from dataclasses import replace

from surefoot.dashboard.live.handlers import disturbances, stones, walking
from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.rewind.run_script import Deed, perform, read_script
from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.runs.run import MOST_ROWS, run
from surefoot.experiments.runs.saved_run import INTERRUPTED, SCRIPT, SavedRun, scenario_of
from surefoot.simulation.physics import TIMESTEP_S

_HANDLERS = {**stones.HANDLERS, **disturbances.HANDLERS, **walking.HANDLERS}


def rerun(kept: SavedRun, progress: Callable[[float], None] | None = None) -> SavedRun:
    """The same run once more: of the command line by its scenario, of the page by all that was done to it.

    Args:
        kept: what was opened.
        progress: called now and then with the part done, 0 to 1.

    Raises:
        InvalidInput, PostureError, ControllerError: what its manifest tells cannot be done here.
    """
    scenario = scenario_of(kept.manifest)
    if SCRIPT not in kept.manifest:
        interrupted = INTERRUPTED in kept.manifest
        if not kept.manifest["summary"] and not interrupted:
            raise InvalidInput("script", None, "is missing: the page saved that run before it kept what was done to it")
        if interrupted:  # as far as it came
            scenario = replace(scenario, duration_s=kept.rows * TIMESTEP_S)
        rows = max(kept.rows, MOST_ROWS)
        result = run(scenario, kept.manifest["controller"], progress=progress, most_rows=rows)
        return SavedRun(tuple(result.recorder.columns), result.recorder.table(), result.manifest)
    controller, changes, ticks, deeds = read_script(kept.manifest[SCRIPT])
    live = LiveRun(scenario, controller, changes)
    done = 0

    def tick() -> None:
        nonlocal done
        live.advance()
        done += 1
        if progress and done % 50 == 0:
            progress(done / ticks)

    def do(deed: Deed) -> None:
        if deed.led_to is not None:
            name, changed = deed.led_to
            live.hand_over(name, dict(changed))
            return
        try:
            _HANDLERS[type(deed.disturbance)](live, deed.disturbance)
        except SurefootError:
            return  # as on the page: a disturbance that came again after a fork may have had nothing to act on

    perform(ticks, deeds, tick, do)
    return live.saved_run(kept.manifest[SCRIPT])
