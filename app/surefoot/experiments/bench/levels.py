"""The levels of every family, a coarse ladder and a fine one; 3, 7, 15 or 31 rungs waste no bisection."""

import numpy as np


def rungs(first: float, last: float, count: int) -> tuple[float, ...]:
    """Equally spaced levels without rounding dust."""
    return tuple(round(level, 6) for level in np.linspace(first, last, count).tolist())


# family -> (quick, full)
LADDERS = {
    "swing": (rungs(0.01, 0.07, 7), rungs(0.005, 0.075, 15)),
    "stone": ((0.006, 0.008, 0.010, 0.012, 0.014, 0.020, 0.028), rungs(0.002, 0.032, 31)),
    "landing": (rungs(0.006, 0.018, 3), rungs(0.002, 0.023, 15)),
    "push": ((0.5, 0.65, 0.8, 0.9, 0.95, 1.0, 1.1), rungs(0.45, 1.2, 31)),
    "push-double": ((0.8, 0.95, 1.05), rungs(0.45, 1.2, 31)),
    "trunk": (rungs(15.0, 45.0, 3), rungs(2.0, 62.0, 31)),
    "stone-push": (rungs(10.0, 30.0, 3), rungs(2.0, 62.0, 31)),
    "slope": ((1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0), rungs(1.0, 15.0, 15)),
    "tilt": (rungs(2.0, 14.0, 7), rungs(1.0, 15.0, 15)),
}
