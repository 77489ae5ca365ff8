"""A live switch without a torque jump: the old torques fade into the new ones."""

import numpy as np

BLEND_TICKS = 50  # 50 ms at 1 kHz


class TorqueBlend:
    """Fades linearly from the torques held at the switch to those the new controller asks for."""

    def __init__(self) -> None:
        self._from: np.ndarray | None = None
        self._tick = 0

    def start(self, torques: np.ndarray | None) -> None:
        """Begin a fade from ``torques`` (15,) [N m]; None when nothing has been applied yet."""
        self._from, self._tick = torques, 0

    def apply(self, torques: np.ndarray) -> np.ndarray:
        """The torques to apply this tick."""
        if self._from is None:
            return torques
        self._tick += 1
        if self._tick >= BLEND_TICKS:
            self._from = None
            return torques
        part = self._tick / BLEND_TICKS
        return self._from + part * (torques - self._from)
