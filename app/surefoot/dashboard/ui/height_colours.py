"""Colours of uneven ground: the higher a block is, the lighter; the same in the scene and in the plan of the feet."""

import numpy as np

from surefoot.dashboard.ui import palette
from surefoot.simulation.terrain import Terrain

_LOWEST: palette.Rgb = (128, 120, 110)
_HIGHEST: palette.Rgb = (226, 220, 210)


def height_colours(terrain: Terrain) -> np.ndarray:
    """Colour (n, 3), 0 to 255, of the top of each block, from the plane's (darkest) to that of the highest one."""
    heights = terrain.rows[:, 4] + terrain.depth_m
    share = heights / max(float(heights.max(initial=0.0)), 1e-9)
    return (np.outer(1.0 - share, _LOWEST) + np.outer(share, _HIGHEST)).astype(np.uint8)
