"""Commands about time: play, pause, step, seek, speed. They change when the world is seen, never the world."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from surefoot.dashboard.live.rewind.history import tick_of
from surefoot.dashboard.messages import commands as ask
from surefoot.errors import InvalidInput

if TYPE_CHECKING:
    from surefoot.dashboard.live.live_run import Stage

_MOST_TICKS = 1000  # of one step


def set_speed(stage: "Stage", command: ask.SetSpeed) -> None:
    """Simulated seconds per second. Raises InvalidInput."""
    if not ask.SLOWEST <= command.speed <= ask.FASTEST:
        raise InvalidInput("speed", command.speed, "out of range", [f"{ask.SLOWEST} to {ask.FASTEST}"])
    stage.speed = float(command.speed)


def play(stage: "Stage", command: ask.Play | ask.TogglePlay) -> None:
    """Run. Raises InvalidInput after a fall has been shown to its end."""
    if stage.ended:
        raise InvalidInput("play", stage.simulation.fallen, "Bip has fallen", ["Reset", "go back in the timeline"])
    stage.playing = True


def pause(stage: "Stage", command: ask.Pause) -> None:
    """Stand still."""
    stage.playing = False


def toggle(stage: "Stage", command: ask.TogglePlay) -> None:
    """Run or stand still."""
    if stage.playing:
        stage.playing = False
    else:
        play(stage, command)


def step(stage: "Stage", command: ask.Step) -> None:
    """Some ticks ahead, or back as far as the past is kept."""
    history = stage.history
    if command.ticks < 0:
        history.seek(max(history.tick + command.ticks, history.oldest))
    stage.playing = False
    for _ in range(min(command.ticks, _MOST_TICKS)):
        if not stage.ended:
            stage.tick()


def seek(stage: "Stage", command: ask.Seek) -> None:
    """Go to an instant and stand still there. Raises InvalidInput when it is not kept."""
    stage.history.seek(tick_of(command.time_s))
    stage.playing = False


def go_live(stage: "Stage", command: ask.GoLive) -> None:
    """Go to the newest instant and run on, if Bip still can."""
    stage.history.seek(stage.history.newest)
    stage.playing = not stage.ended


def repeat_disturbances(stage: "Stage", command: ask.RepeatDisturbances) -> None:
    """Whether disturbances come again after a fork."""
    stage.history.repeat = bool(command.repeat)


OBEY: dict[type, Callable[["Stage", Any], None]] = {
    ask.SetSpeed: set_speed, ask.Play: play, ask.Pause: pause, ask.TogglePlay: toggle, ask.Step: step, ask.Seek: seek,
    ask.GoLive: go_live, ask.RepeatDisturbances: repeat_disturbances,
}  # fmt: skip
