"""Pushes: a constant force for a while, on a link or through the centre of mass."""

import math
from dataclasses import dataclass

import numpy as np

from surefoot.field_metadata import check_fields, number

WHOLE_ROBOT = "com"


@dataclass(frozen=True, kw_only=True)
class Push:
    """A horizontal push of constant force impulse / duration. Validated in ``__post_init__`` (InvalidInput).

    Attributes:
        link: a link (force at its centre of mass) or ``com`` (force through the whole robot's centre of mass).
        direction_deg: 0 = forward, 90 = to the left.
        impulse_ns: [N s].
        start_s, duration_s: [s].
    """

    link: str = WHOLE_ROBOT
    direction_deg: float = number(0.0, -360.0, 360.0, "deg", "0 = forward, 90 = to the left", step=5.0)
    impulse_ns: float = number(10.0, 0.0, 500.0, "N s", "impulse: force times duration", step=1.0)
    start_s: float = number(1.0, 0.0, 1e6, "s", "when it starts")
    duration_s: float = number(0.1, 0.001, 10.0, "s", "how long it lasts", step=0.01)

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "push")

    @property
    def direction(self) -> np.ndarray:
        """Unit vector (2,) in world."""
        angle = math.radians(self.direction_deg)
        return np.array((math.cos(angle), math.sin(angle)))

    def active_at(self, time_s: float) -> bool:
        """Whether it pushes at a time; half a microsecond of slack keeps the number of ticks exact."""
        return self.start_s - 5e-7 <= time_s < self.start_s + self.duration_s - 5e-7

    def force(self) -> np.ndarray:
        """Force (3,) in world [N] while it lasts."""
        size, (x, y) = self.impulse_ns / self.duration_s, self.direction
        return np.array((size * x, size * y, 0.0))
