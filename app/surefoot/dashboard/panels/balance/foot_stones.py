"""Stones in the plan of the soles: the outline of each, its height now, and where a wedge rises to."""

from html import escape
from typing import Protocol

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.messages.stone_view import StoneView
from surefoot.dashboard.ui import palette
from surefoot.simulation.stones import HALF_BALL, WEDGE

_ROUND = 24  # corners of a half-ball's outline
_LANDED_M = 1e-4


class Plan(Protocol):
    """Where world points fall on the picture."""

    def points(self, places: np.ndarray) -> np.ndarray:
        """Pixels (n, 2) of world places (n, 2 or more) [m]."""
        ...


def stones_svg(plan: Plan, geometry: Geometry, width: float, height: float) -> tuple[list[str], list[str]]:
    """Those stones that reach into a picture of that many pixels: what lies below the soles, and what is read above."""
    below, above = [], []
    for view in geometry.stones:
        corners = plan.points(stone_outline(view, geometry.ground_rotation))
        low, high = corners.min(axis=0), corners.max(axis=0)
        if np.isfinite(corners).all() and (high > 0.0).all() and low[0] < width and low[1] < height:
            below.append(_area(view, corners))
            above.append(_label(view, corners))
    return below, above


def stone_outline(view: StoneView, ground_rotation: np.ndarray) -> np.ndarray:
    """Outline (n, 3) in world [m] of what a stone covers of the ground, seen from above; a wedge's is its top's.

    Args:
        view: the stone.
        ground_rotation: (3, 3) ground axes to world.
    """
    a, b = 0.5 * view.stone.size_m[0], 0.5 * view.stone.size_m[1]
    if view.stone.shape == HALF_BALL:
        turn = np.linspace(0.0, 2.0 * np.pi, _ROUND, endpoint=False)
        local = np.column_stack((a * np.cos(turn), b * np.sin(turn), np.zeros(_ROUND)))
    else:
        local = np.array(((-a, -b, 0.0), (a, -b, 0.0), (a, b, 0.0), (-a, b, 0.0)))
        local = local.dot(view.stone.rotation().T) if view.stone.shape == WEDGE else local
    return np.array(view.position) + local.dot(ground_rotation.T)


def _area(view: StoneView, corners: np.ndarray) -> str:
    colour, falling = palette.css(palette.STONE), view.stone.drops and view.top_m > view.stone.height_m + _LANDED_M
    points = " ".join(f"{u:.1f},{v:.1f}" for u, v in corners)
    dash = ' stroke-dasharray="4 3"' if falling else ""
    return (
        f'<polygon data-stone="{view.number}" points="{points}" fill="{colour}" '
        f'fill-opacity="{0.15 if falling else 0.6}" stroke="{colour}" stroke-width="1.3"{dash}/>'
    )


def _label(view: StoneView, corners: np.ndarray) -> str:
    """Its height now [mm], what it is as a tooltip, and a wedge's arrow."""
    stone, (x, y) = view.stone, corners.mean(axis=0) + (0.0, 13.0 if view.stone.shape == WEDGE else 3.5)
    title = f"stone {view.number}: {stone.shape}, {1e3 * stone.height_m:.0f} mm high, {1e3 * view.top_m:.0f} mm now"
    return (
        f'<g data-stone-label="{view.number}"><title>{escape(title)}</title>{_slope(view, corners)}'
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="middle" fill="#fff" stroke="{palette.css(palette.STONE)}" '
        f'stroke-width="2.5" paint-order="stroke">{1e3 * view.top_m:.0f} mm</text></g>'
    )


def _slope(view: StoneView, corners: np.ndarray) -> str:
    """An arrow from a wedge's middle to where it rises to; forward is up, left is left."""
    if view.stone.shape != WEDGE:
        return ""
    direction = np.deg2rad(view.stone.slope_direction_deg)
    reach = 0.45 * float((corners.max(axis=0) - corners.min(axis=0)).min())
    x, y = corners.mean(axis=0)
    dx, dy = -np.sin(direction), -np.cos(direction)
    u, v = x + reach * dx, y + reach * dy
    left = f"{u - 4 * dx - 3 * dy:.1f} {v - 4 * dy + 3 * dx:.1f}"
    right = f"{u - 4 * dx + 3 * dy:.1f} {v - 4 * dy - 3 * dx:.1f}"
    return (
        f'<path d="M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}M{left}L{u:.1f} {v:.1f}L{right}" stroke="#fff" stroke-width="1.4"/>'
    )
