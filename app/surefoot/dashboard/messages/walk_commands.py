"""Steering a robot that walks; ``commands`` offers them with all others."""

from dataclasses import dataclass

from surefoot.dashboard.messages.command_base import WorldCommand


@dataclass(frozen=True, kw_only=True)
class SteerWalk(WorldCommand):
    """Other steps from the next lift-off on; a robot that stands at its walk's end walks on.

    Attributes:
        step_length_m, turn_deg_per_step: as in a scenario's reference.
        steps: how many are to come, the closing one included; 0: as many as are.
    """

    step_length_m: float
    turn_deg_per_step: float
    steps: int = 0


@dataclass(frozen=True)
class StopWalk(WorldCommand):
    """The next step that is lifted sets the feet beside each other, and is the last one."""
