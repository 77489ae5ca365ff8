"""Narrow screens: the controls take the whole width of a phone, and its camera looks at the robot above them."""

import numpy as np

Place = tuple[tuple[float, float, float], tuple[float, float, float]]

_NARROW = 0.57  # width over height: a telephone; what two panels leave of a usual window is wider
_FARTHER = 1.75
_LOWER_M = 0.75  # how far the middle of the picture falls: the lower half is under the controls

# viser's bottom sheet is 20em wide and hides up to 60 % of the scene
STYLE = """<style>@media (max-width: 36em) {
  div[style*="width: 20em"] { width: 100vw !important; }
  div[style*="max-height: 60%"] { max-height: 46% !important; }
}</style>"""


def placed_for(place: Place, aspect: float) -> Place:
    """A camera's position and target for a window: farther away and looking lower where it is narrow.

    Args:
        place: for a wide window.
        aspect: width over height.
    """
    if aspect >= _NARROW:
        return place
    position, target = np.array(place[0]), np.array(place[1])
    reach = float(np.linalg.norm(position - target))
    lower = target - (0.0, 0.0, _LOWER_M * min(reach / 3.0, 1.0))
    away = lower + _FARTHER * (position - target)
    return (away[0], away[1], away[2]), (lower[0], lower[1], lower[2])
