"""Which command of a twin run is for whom; its audience says so. Most are for both: disturbances, pace, reset."""

from collections.abc import Iterable

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.command_base import Audience, Command, TwinCommand


def for_first(command: Command) -> Command | None:
    """What the first robot is asked to do by a command; None for nothing."""
    return None if command.audience is Audience.TWIN else command


def for_twin(command: Command) -> Command | None:
    """What the twin is asked to do by it; None for nothing."""
    if isinstance(command, TwinCommand):
        return command.for_twin()
    return None if command.audience is Audience.FIRST else command


def split(
    commands: Iterable[Command], *, playing: bool, first_over: bool, twin_over: bool
) -> tuple[tuple[Command, ...], tuple[Command, ...]]:
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
        if isinstance(command, cmd.TogglePlay):  # one by one they would get out of step
            command = cmd.Pause() if playing else cmd.Play()
        for chosen, route, over in ((first, for_first, first_over), (twin, for_twin, twin_over)):
            asked = route(command)
            if asked is not None and not (over and isinstance(asked, cmd.Play)):
                chosen.append(asked)
    return tuple(first), tuple(twin)
