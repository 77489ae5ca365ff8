"""Uneven ground in the plan of the soles: the blocks below them, the higher the lighter, with their heights."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.panels.balance.foot_stones import Plan
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.height_colours import height_colours
from surefoot.simulation.terrain import Terrain

_LABEL_PX = (26.0, 12.0)  # a block that shows less than this has no room for its height
_REACH_M = 0.5  # the picture's corners are nearer to P
_CORNERS = np.array(((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)))


def terrain_svg(plan: Plan, geometry: Geometry, terrain: Terrain, width: float, height: float) -> list[str]:
    """What of the blocks reaches into a picture of that many pixels, the highest last; nothing of level ground."""
    if not terrain.blocks:
        return []
    near = _near(terrain, geometry)
    tops, colours = terrain.rows[near, 4], height_colours(terrain)[near]
    pixels = plan.points(_corners(terrain.rows[near], geometry).reshape(-1, 3)).reshape(-1, 4, 2)
    seen = ((pixels.max(axis=1) > 0.0) & (pixels.min(axis=1) < (width, height))).all(axis=1)
    order = sorted(np.flatnonzero(seen).tolist(), key=lambda i: tops[i])
    areas = [_area(pixels[i], tuple(colours[i].tolist())) for i in order]
    labels = [_label(pixels[i], float(tops[i]), width, height) for i in order]
    return [
        f'<g data-terrain fill-opacity="0.8" stroke="#6b6258" stroke-opacity="0.55" stroke-width="0.7">'
        f"{''.join(areas)}</g>",
        f'<g text-anchor="middle" fill="#3a342c" font-size="8.5">{"".join(labels)}</g>',
    ]


def _near(terrain: Terrain, geometry: Geometry) -> np.ndarray:
    """Indices of the blocks that come near to the feet: of a long walk only few do."""
    pivot, turn = geometry.ground_pivot, geometry.ground_rotation
    here = (pivot + (geometry.support_origin - pivot) @ turn)[:2]
    rows = terrain.rows
    return np.flatnonzero((np.abs(rows[:, :2] - here) <= 0.5 * rows[:, 2:4] + _REACH_M).all(axis=1))


def _corners(rows: np.ndarray, geometry: Geometry) -> np.ndarray:
    """Corners (n, 4, 3) in world [m] of the tops of blocks (n, 5), where the ground has been turned to."""
    level = np.repeat(rows[:, None, (0, 1, 4)], 4, axis=1)
    level[:, :, :2] += _CORNERS * rows[:, None, 2:4]
    pivot, turn = geometry.ground_pivot, geometry.ground_rotation
    return pivot + (level - pivot) @ turn.T


def _area(corners: np.ndarray, colour: palette.Rgb) -> str:
    (x, y), *others = corners
    path = "".join(f"L{u:.1f} {v:.1f}" for u, v in others)
    return f'<path d="M{x:.1f} {y:.1f}{path}Z" fill="{palette.css(colour)}"/>'


def _label(corners: np.ndarray, top_m: float, width: float, height: float) -> str:
    """How high it is above level zero [mm], in the middle of what is seen of it."""
    low, high = np.maximum(corners.min(axis=0), 0.0), np.minimum(corners.max(axis=0), (width, height))
    if ((high - low) < _LABEL_PX).any():
        return ""
    x, y = 0.5 * (low + high)
    return f'<text x="{x:.1f}" y="{y + 3.0:.1f}">{1e3 * top_m:+.0f}</text>'
