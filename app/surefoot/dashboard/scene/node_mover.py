"""Moves what is drawn only as far as one can see: what stands still costs neither the page nor the browser anything.

Viser compares every pose that it is given with the one before, at 60 us each, and the browser draws again for the
smallest change.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import viser

SEEN = 2e-5  # m, or of a unit quaternion's components: a tenth of a pixel at arm's length


class NodeMover:
    """Remembers what was drawn last."""

    def __init__(self) -> None:
        self._last: dict[tuple[int, str], np.ndarray] = {}
        self._positions = self._quaternions = np.empty((0, 0))
        self._nodes: Sequence[Any] = ()

    def set(self, node: Any, name: str, value: np.ndarray, least: float = SEEN) -> None:
        """Set an array of a node, unless no component changed by more than ``least``."""
        key, value = (id(node), name), np.asarray(value)
        before = self._last.get(key)
        if before is None or before.shape != value.shape or not np.abs(value - before).max(initial=0.0) <= least:
            setattr(node, name, value)
            self._last[key] = value.copy()

    def place(self, nodes: Sequence[viser.SceneNodeHandle], positions: np.ndarray, quaternions: np.ndarray) -> None:
        """Place many nodes at once: positions (n, 3) [m], quaternions (n, 4), w first."""
        if nodes is not self._nodes:  # others than before
            self._nodes = nodes
            self._positions = np.full(positions.shape, np.nan)
            self._quaternions = np.full(quaternions.shape, np.nan)
        far = ~(np.abs(positions - self._positions).max(axis=1) <= SEEN)
        turned = ~(np.abs(quaternions - self._quaternions).max(axis=1) <= SEEN)
        for i in np.flatnonzero(far).tolist():
            nodes[i].position = positions[i]
        for i in np.flatnonzero(turned).tolist():
            nodes[i].wxyz = quaternions[i]
        self._positions[far], self._quaternions[turned] = positions[far], quaternions[turned]
