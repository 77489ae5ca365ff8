"""Which command of a twin run is for whom. What is not named here is for both: disturbances, pace, scenario, reset."""

from collections.abc import Iterable

from surefoot.dashboard.messages import commands as ask

_FIRST_ONLY = (
    ask.SetController, ask.ChangeSettings, ask.ResetSettings, ask.UndoSettings, ask.RedoSettings, ask.UseSettings,
)  # fmt: skip


def for_first(command: ask.Command) -> ask.Command | None:
    """What the first robot is asked to do by a command; None for nothing."""
    return None if isinstance(command, ask.TwinCommand) else command


def for_twin(command: ask.Command) -> ask.Command | None:
    """What the twin is asked to do by it; None for nothing."""
    if isinstance(command, ask.SetTwinController):
        return ask.SetController(command.name)
    if isinstance(command, ask.ChangeTwinSettings):
        return ask.ChangeSettings(command.changes)
    return None if isinstance(command, (*_FIRST_ONLY, ask.StartTwin, ask.StopTwin)) else command


def split(
    commands: Iterable[ask.Command], *, playing: bool, first_over: bool, twin_over: bool
) -> tuple[tuple[ask.Command, ...], tuple[ask.Command, ...]]:
    """Commands for the first robot and for its twin.

    Args:
        commands: in order.
        playing: whether either of them plays.
        first_over: the first has been shown to its end and stays where it fell while the twin goes on.
        twin_over: likewise the other way round.
    """
    first, twin = [], []
    for given in commands:
        command = given
        if isinstance(command, ask.TogglePlay):  # one by one they would get out of step
            command = ask.Pause() if playing else ask.Play()
        for chosen, route, over in ((first, for_first, first_over), (twin, for_twin, twin_over)):
            asked = route(command)
            if asked is not None and not (over and isinstance(asked, ask.Play)):
                chosen.append(asked)
    return tuple(first), tuple(twin)
