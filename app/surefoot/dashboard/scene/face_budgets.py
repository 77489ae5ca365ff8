"""How many faces each mesh of a robot may keep on its way to the browser: those that look large, the more."""

from collections.abc import Hashable, Mapping
from typing import TypeVar

import numpy as np

_Key = TypeVar("_Key", bound=Hashable)


def shared_faces(wanted: Mapping[_Key, int], sizes: Mapping[_Key, float], most: int) -> dict[_Key, int]:
    """Shares of a budget, in proportion to sizes; what one does not want goes to the others in the same proportion.

    Args:
        wanted: how many faces each has.
        sizes: how large each looks; an area [m2], so that the grids of all are about equally fine.
        most: of all together.

    Returns:
        No more than wanted, at least one each.
    """
    shares, left, open_ones = dict(wanted), most, set(wanted)
    while sum(wanted[key] for key in open_ones) > left:
        whole = sum(sizes[key] for key in open_ones)
        even = {key: left * sizes[key] / whole if whole > 0.0 else left / len(open_ones) for key in open_ones}
        content = {key for key in open_ones if wanted[key] <= even[key]}
        if not content:
            shares |= {key: max(1, int(even[key])) for key in open_ones}
            break
        open_ones -= content
        left -= sum(wanted[key] for key in content)
    return shares


def box_area(points: np.ndarray) -> float:
    """Half the surface [m2] of the box around points (n, 3) [m]."""
    a, b, c = np.ptp(points, axis=0).tolist()
    return a * b + b * c + c * a
