"""Make a saved run again, from its file alone."""

from collections.abc import Callable

from surefoot.dashboard.live.handlers import disturbances, stones
from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.rewind.run_script import Deed, perform, read_script
from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.runs.run import run
from surefoot.experiments.runs.saved_run import SCRIPT, SavedRun, scenario_of

_HANDLERS = {**stones.HANDLERS, **disturbances.HANDLERS}


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
        if not kept.manifest["summary"]:
            raise InvalidInput("script", None, "is missing: the page saved that run before it kept what was done to it")
        result = run(scenario, kept.manifest["controller"], progress=progress)
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
