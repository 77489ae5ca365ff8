"""Exponential and logarithm of rotations, and the skew matrix, by Pinocchio: in an eighth to a third of our time.

``geometry.rotations`` has the same, with other last digits, for layers that know no Pinocchio.
"""

from collections.abc import Callable

import numpy as np

from surefoot.robot.pinocchio_library import pin

turn_of: Callable[[np.ndarray], np.ndarray] = pin.exp3
"""Rotation (3, 3) by a rotation vector (3,) [rad]."""

vector_of: Callable[[np.ndarray], np.ndarray] = pin.log3
"""Rotation vector (3,) [rad] of a rotation (3, 3); the inverse of ``turn_of`` up to half a turn."""

skew_of: Callable[[np.ndarray], np.ndarray] = pin.skew
"""The (3, 3) matrix with ``skew_of(a) @ b == cross(a, b)``."""
