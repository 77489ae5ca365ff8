"""Cross products of single 3-vectors, written out: ``np.cross`` costs ten times as much on three numbers."""

import numpy as np


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Vector product a x b of two (3,) vectors."""
    ax, ay, az = a.tolist()
    bx, by, bz = b.tolist()
    return np.array((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))


def skew(a: np.ndarray) -> np.ndarray:
    """The (3, 3) matrix with ``skew(a) @ b == cross(a, b)``."""
    x, y, z = a.tolist()
    return np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
