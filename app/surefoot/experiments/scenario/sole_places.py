"""The nine places of a sole where stones come up or lie."""

from functools import lru_cache

import numpy as np

from surefoot.experiments.scenario.robots import robot_named
from surefoot.robot.feet import Support

_LENGTHWISE = {"heel": 0, "": 1, "toe": 2}
_ACROSS = {"inner": 0, "": 1, "outer": 2}
_INSET = 0.95  # of the way from the middle to the outline: a stone's centre is under the sole


@lru_cache(maxsize=4)
def sole_places(robot: str, support: Support) -> dict[str, tuple[float, float]]:
    """Name -> (x, y) [m] from the point below the stance ankle: corners, middles of the edges, and the middle."""
    foot = robot_named(robot).feet[support.reference_foot]
    low, high = foot.sole.vertices[:, 0].min(), foot.sole.vertices[:, 0].max()
    middle, half_length = 0.5 * (low + high), 0.5 * _INSET * (high - low)
    outward = -1.0 if support is Support.RIGHT else 1.0
    places = {}
    for along, i in _LENGTHWISE.items():
        for across, j in _ACROSS.items():
            name = "-".join(part for part in (along, across) if part) or "middle"
            x = middle + (i - 1) * half_length
            half_width = _INSET * foot.sole.distance_to_edge(np.array((x, 0.0)), np.array((0.0, 1.0)))
            y = (j - 1) * outward * half_width
            places[name] = (round(float(x), 4), round(float(y), 4))
    return places
