"""Play, pause, step, speed, scenario, and the way back through the last seconds."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from surefoot.dashboard.messages.command_base import PlaybackCommand

SLOWEST, FASTEST = 0.1, 2.0
MOST_STEP_TICKS = 1000


@dataclass(frozen=True)
class SetSpeed(PlaybackCommand):
    """Simulated seconds per second, 0.1 to 2."""

    speed: float


@dataclass(frozen=True)
class Play(PlaybackCommand):
    """Run."""


@dataclass(frozen=True)
class Pause(PlaybackCommand):
    """Stand still."""


@dataclass(frozen=True)
class TogglePlay(PlaybackCommand):
    """Run if paused, pause if running."""


@dataclass(frozen=True)
class Step(PlaybackCommand):
    """Pause, and advance by some milliseconds; go back when they are negative."""

    ticks: int = 1

    @property
    def ahead(self) -> int:
        """Ticks that are made."""
        return min(max(self.ticks, 0), MOST_STEP_TICKS)


@dataclass(frozen=True)
class Reset(PlaybackCommand):
    """Back to the start of the scenario; controller, settings and friction stay. Runs if ``play``."""

    play: bool = True


@dataclass(frozen=True)
class LoadScenario(PlaybackCommand):
    """Start another scenario, a shipped one by name or a file; robot, controller and changed settings stay.

    So do sensors, estimator, motors, delay and errors of the model, unless the scenario has any of them of its own.

    Attributes:
        name: of it, or the file.
        changes: dotted path -> value, as ``--set`` takes them.
    """

    name: str
    changes: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class ChooseRobot(PlaybackCommand):
    """Start the scenario again with another robot; controller and changed settings stay.

    Attributes:
        robot: a name, or the file that the page was started with.
    """

    robot: str


@dataclass(frozen=True)
class ChangeSensing(PlaybackCommand):
    """Start the scenario again with other sensors, motors or errors of the model: they are drawn once for a run.

    Attributes:
        sensors: field of ``SensorSettings`` -> value. With a ``preset`` all that is not named is as that has it, but
            for seed and place of the IMU; without one all that is not named stays.
        estimator: a name; empty for the one at work.
        motors, model_error: fields of ``MotorSettings`` and ``ModelErrorSettings``, likewise.
        control_delay_s: from the controller to the motors [s]; None for the one at work.
    """

    sensors: Mapping[str, Any] = field(default_factory=dict)
    estimator: str = ""
    motors: Mapping[str, Any] = field(default_factory=dict)
    model_error: Mapping[str, Any] = field(default_factory=dict)
    control_delay_s: float | None = None


@dataclass(frozen=True)
class Refused(PlaybackCommand):
    """A command that made no sense, in its stead: it is only told."""

    text: str


@dataclass(frozen=True)
class OpenLink(PlaybackCommand):
    """Start what the query of a link asks for: scenario, controller and changed values.

    Attributes:
        query: of the link.
        ticket: names this asking, so that its outcome can be told from others.
    """

    query: str
    ticket: str = ""


@dataclass(frozen=True)
class Seek(PlaybackCommand):
    """Pause, and go to an instant of the last 30 s.

    Attributes:
        time_s: simulated, since the start of the run.
    """

    time_s: float


@dataclass(frozen=True)
class GoLive(PlaybackCommand):
    """Go to the newest instant and run."""


@dataclass(frozen=True)
class RepeatDisturbances(PlaybackCommand):
    """Whether disturbances come again after a fork."""

    repeat: bool
