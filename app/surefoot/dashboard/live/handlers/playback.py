"""Commands about time: play, pause, step, seek, speed. They change when the world is seen, never the world."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from surefoot.dashboard.live.rewind.history import tick_of
from surefoot.dashboard.messages import commands as cmd
from surefoot.errors import InvalidInput

if TYPE_CHECKING:
    from surefoot.dashboard.live.live_run import LiveRun

_MOST_TICKS = 1000  # of one step


def set_speed(live: "LiveRun", command: cmd.SetSpeed) -> None:
    """Simulated seconds per second. Raises InvalidInput."""
    if not cmd.SLOWEST <= command.speed <= cmd.FASTEST:
        raise InvalidInput("speed", command.speed, "out of range", [f"{cmd.SLOWEST} to {cmd.FASTEST}"])
    live.speed = float(command.speed)


def play(live: "LiveRun", command: cmd.Play | cmd.TogglePlay) -> None:
    """Run. Raises InvalidInput after a fall has been shown to its end."""
    if live.ended:
        raise InvalidInput("play", live.simulation.fallen, "Bip has fallen", ["Reset", "go back in the timeline"])
    live.playing = True


def pause(live: "LiveRun", command: cmd.Pause) -> None:
    """Stand still."""
    live.playing = False


def toggle(live: "LiveRun", command: cmd.TogglePlay) -> None:
    """Run or stand still."""
    if live.playing:
        live.playing = False
    else:
        play(live, command)


def step(live: "LiveRun", command: cmd.Step) -> None:
    """Some ticks ahead, or back as far as the past is kept."""
    history = live.history
    if command.ticks < 0:
        history.seek(max(history.tick + command.ticks, history.oldest))
    live.playing = False
    for _ in range(min(command.ticks, _MOST_TICKS)):
        if not live.ended:
            live.tick()


def seek(live: "LiveRun", command: cmd.Seek) -> None:
    """Go to an instant and stand still there. Raises InvalidInput when it is not kept."""
    live.history.seek(tick_of(command.time_s))
    live.playing = False


def go_live(live: "LiveRun", command: cmd.GoLive) -> None:
    """Go to the newest instant and run on, if Bip still can."""
    live.history.seek(live.history.newest)
    live.playing = not live.ended


def repeat_disturbances(live: "LiveRun", command: cmd.RepeatDisturbances) -> None:
    """Whether disturbances come again after a fork."""
    live.history.repeat = bool(command.repeat)


OBEY: dict[type, Callable[["LiveRun", Any], None]] = {
    cmd.SetSpeed: set_speed, cmd.Play: play, cmd.Pause: pause, cmd.TogglePlay: toggle, cmd.Step: step, cmd.Seek: seek,
    cmd.GoLive: go_live, cmd.RepeatDisturbances: repeat_disturbances,
}  # fmt: skip
