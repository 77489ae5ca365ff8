"""The gains of the sweep: of the centre of mass, from soft (shaped like capture-point control) to stiff."""

from dataclasses import dataclass
from typing import Any

from surefoot.momentum.capture import natural_frequency
from surefoot.task.posture import DEFAULT_COM_HEIGHT

CAPTURE_SHAPES = (0.3, 0.6, 1.0)  # k: K_P = k omega^2, K_D = (1 + k) omega puts one pole at -omega, one at -k omega
STIFF = ((20.0, 9.0), (60.0, 14.0), (100.0, 20.0))  # K_P [1/s2], K_D [1/s]


@dataclass(frozen=True)
class GainSet:
    """One column of the sweep.

    Attributes:
        label: how tables call it.
        stiffness, damping: K_P [1/s2] and K_D [1/s] of the centre of mass.
    """

    label: str
    stiffness: float
    damping: float

    @property
    def changes(self) -> tuple[tuple[str, Any], ...]:
        """What a case has to change."""
        return (("controller.com_stiffness", self.stiffness), ("controller.com_damping", self.damping))


def _capture_shaped(k: float) -> GainSet:
    omega = natural_frequency(DEFAULT_COM_HEIGHT)
    stiffness, damping = round(k * omega**2, 2), round((1.0 + k) * omega, 2)
    return GainSet(f"k = {k:g}: {stiffness:.3g}/{damping:.3g}", stiffness, damping)


GAINS = (
    *(_capture_shaped(k) for k in CAPTURE_SHAPES),
    *(GainSet(f"{stiffness:g}/{damping:g}", stiffness, damping) for stiffness, damping in STIFF),
)
