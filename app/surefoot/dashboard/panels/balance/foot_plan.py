"""The soles seen from above, as an SVG: the two-dimensional picture that people know from papers."""

from dataclasses import dataclass

import numpy as np

from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.panels.balance.foot_believed import believed_svg, patches_svg
from surefoot.dashboard.panels.balance.foot_stones import stones_svg
from surefoot.dashboard.panels.balance.foot_terrain import terrain_svg
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.symbols import FROM_BELOW, PointSymbol, mark
from surefoot.simulation.terrain import LEVEL, Terrain

WIDTH, HEIGHT = 310, 262  # pixels
_DOUBLE_PER_M, _SINGLE_PER_M = 620.0, 780.0  # pixels; for Bip, others' with the room that their soles take
_BIP_WIDE_M, _BIP_LONG_M = 0.40, 0.29  # from the outer edge of one sole to that of the other, and along a sole
_AROUND_M = 0.02  # left free beside two soles that are both to be seen
_BORDER = 9.0
_GRID_MM = 50.0
_TRAIL_POINTS = 40


@dataclass(frozen=True)
class Plan:
    """Where world points fall on the picture: forward is up, left is left.

    Attributes:
        origin: (2,) world point [m] in the middle of the picture.
        scale: pixels per metre.
    """

    origin: np.ndarray
    scale: float

    def points(self, places: np.ndarray) -> np.ndarray:
        """Pixels (n, 2) of world places (n, 2 or more) [m]."""
        away = self.scale * (places[:, :2] - self.origin)
        return np.column_stack((0.5 * WIDTH - away[:, 1], 0.5 * HEIGHT - away[:, 0]))

    def point(self, place: np.ndarray) -> np.ndarray:
        """Pixels (2,) of one place."""
        return self.points(place[None, :])[0]


def plan_of(geometry: Geometry, support: str, robot: ShownRobot) -> Plan:
    """The picture's middle and scale.

    On one foot both soles are seen where that costs no scale against Bip's, whose free foot is half outside; else the
    foot that stands is in the middle, as on both feet the point between them is.

    Args:
        geometry: where everything is.
        support: left, right or double.
        robot: whose soles.
    """
    (length, width), both = robot.sole_m, robot.apart_m + robot.sole_m[1]
    middle, aside = geometry.support_origin[:2] + (robot.ahead_m, 0.0), 0.0
    if support == "double":
        return Plan(middle, _DOUBLE_PER_M / max(both / _BIP_WIDE_M, length / _BIP_LONG_M))
    scale = _SINGLE_PER_M * _BIP_LONG_M / length
    whole = WIDTH / (both + 2.0 * _AROUND_M)
    if whole >= _SINGLE_PER_M:
        scale, aside = min(scale, whole), 0.5 * (both - width)
    return Plan(middle + (0.0, -aside if support == "left" else aside), scale)


def foot_plan(geometry: Geometry, support: str, robot: ShownRobot, margin_m: float, terrain: Terrain = LEVEL) -> str:
    """The picture.

    Args:
        geometry: where everything is.
        support: left, right or double.
        robot: whose soles.
        margin_m: of the measured ZMP; NaN where unknown.
        terrain: what stands on the ground from the start.
    """
    plan = plan_of(geometry, support, robot)
    stones, labels = stones_svg(plan, geometry, WIDTH, HEIGHT)
    ground = terrain_svg(plan, geometry, terrain, WIDTH, HEIGHT)
    parts = [_grid(plan, geometry), *ground, *stones, *_soles(plan, geometry), _polygon(plan, geometry), *labels]
    parts += [_trail(plan, point.trail(geometry), point.colour) for point in FROM_BELOW]
    parts += [_ankle(plan, geometry), _margin(plan, geometry, margin_m)]
    parts += patches_svg(plan, geometry)
    parts += [_mark(plan, point, point.place(geometry)) for point in FROM_BELOW]
    parts += believed_svg(plan, geometry)
    parts += [_scale_bar(plan), _AXES]
    return (
        f'<svg role="img" aria-label="Soles seen from above" viewBox="0 0 {WIDTH} {HEIGHT}" width="100%" '
        f'style="display:block;font:10px sans-serif" fill="none">{"".join(parts)}</svg>'
    )


def nearest_on_outline(corners: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The point (2,) of a polygon's outline (n, 2) that is nearest to a place (2,)."""
    along = np.roll(corners, -1, axis=0) - corners
    part = np.clip(((place - corners) * along).sum(axis=1) / (along * along).sum(axis=1), 0.0, 1.0)
    feet = corners + part[:, None] * along
    return feet[((feet - place) ** 2).sum(axis=1).argmin()]


def _path(points: np.ndarray) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def _grid(plan: Plan, geometry: Geometry) -> str:
    """Lines every 50 mm from P."""
    step = 1e-3 * _GRID_MM * plan.scale
    x, y = plan.point(geometry.support_origin)
    down = [f"M{x + i * step:.1f} 0V{HEIGHT}" for i in range(-9, 10)]
    across = [f"M0 {y + i * step:.1f}H{WIDTH}" for i in range(-9, 10)]
    return f'<path d="{"".join(down + across)}" stroke="currentColor" stroke-opacity="0.09"/>'


def _soles(plan: Plan, geometry: Geometry) -> list[str]:
    return [
        f'<polygon points="{_path(plan.points(sole))}" fill="currentColor" fill-opacity="0.05" '
        f'stroke="{palette.css(palette.SOLE)}" stroke-width="1.3" stroke-linejoin="round"/>'
        for sole in geometry.soles
        if np.isfinite(sole).all()
    ]


def _polygon(plan: Plan, geometry: Geometry) -> str:
    if len(geometry.support_polygon) < 3:
        return ""
    colour = palette.css(palette.POLYGON)
    return (
        f'<polygon points="{_path(plan.points(geometry.support_polygon))}" fill="{colour}" fill-opacity="0.28" '
        f'stroke="{colour}" stroke-width="2" stroke-linejoin="round"/>'
    )


def _trail(plan: Plan, path: np.ndarray, colour: palette.Rgb) -> str:
    known = path[np.isfinite(path).all(axis=1)][-_TRAIL_POINTS:]
    if len(known) < 2:
        return ""
    return (
        f'<polyline points="{_path(plan.points(known))}" stroke="{palette.css(colour)}" stroke-width="1.6" '
        'stroke-opacity="0.55" stroke-linejoin="round"/>'
    )


def _ankle(plan: Plan, geometry: Geometry) -> str:
    x, y = plan.point(geometry.support_origin)
    return (
        f'<path d="M{x - 5:.1f} {y:.1f}h10M{x:.1f} {y - 5:.1f}v10" stroke="currentColor" stroke-opacity="0.55"/>'
        f'<text x="{x + 6:.1f}" y="{y + 11:.1f}" fill="currentColor" fill-opacity="0.6">P</text>'
    )


def _margin(plan: Plan, geometry: Geometry, margin_m: float) -> str:
    """The line from the measured ZMP to the nearest edge, with the distance."""
    if len(geometry.support_polygon) < 3 or not np.isfinite(geometry.zmp_measured).all() or margin_m != margin_m:
        return ""
    edge = nearest_on_outline(geometry.support_polygon[:, :2], geometry.zmp_measured)
    (x, y), (u, v) = plan.points(np.vstack((geometry.zmp_measured, edge)))
    colour = palette.margin_colour(margin_m)
    return (
        f'<path d="M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}" stroke="{colour}" stroke-width="1.6" stroke-dasharray="3 2"/>'
        f'<circle cx="{u:.1f}" cy="{v:.1f}" r="2.5" fill="{colour}"/>'
    )


def _mark(plan: Plan, point: PointSymbol, place: np.ndarray) -> str:
    """A mark at a place, or an arrowhead at the border where it lies beyond."""
    if not np.isfinite(place).all():
        return ""
    x, y = plan.point(place)
    if _BORDER <= x <= WIDTH - _BORDER and _BORDER <= y <= HEIGHT - _BORDER:
        return mark(point, float(x), float(y))
    ahead = np.array((x - 0.5 * WIDTH, y - 0.5 * HEIGHT))
    ahead *= min(
        (0.5 * WIDTH - _BORDER) / max(abs(ahead[0]), 1e-9), (0.5 * HEIGHT - _BORDER) / max(abs(ahead[1]), 1e-9)
    )
    turn = np.degrees(np.arctan2(ahead[1], ahead[0]))
    return (
        f'<path d="M8 0L-5 6L-5 -6Z" fill="{palette.css(point.colour)}" '
        f'transform="translate({0.5 * WIDTH + ahead[0]:.1f} {0.5 * HEIGHT + ahead[1]:.1f}) rotate({turn:.0f})"/>'
    )


def _scale_bar(plan: Plan) -> str:
    length = 1e-3 * _GRID_MM * plan.scale
    return (
        f'<path d="M10 {HEIGHT - 14}v4h{length:.1f}v-4" stroke="currentColor" stroke-width="1.3"/>'
        f'<text x="{10 + 0.5 * length:.1f}" y="{HEIGHT - 14}" text-anchor="middle" fill="currentColor">'
        f"{_GRID_MM:.0f} mm</text>"
    )


_AXES = (
    f'<g stroke="currentColor" stroke-width="1.3" fill="currentColor" '
    f'transform="translate({WIDTH - 18} {HEIGHT - 14})">'
    '<path d="M0 0V-26M0 0H-26" fill="none"/><path stroke="none" d="M-3.5 -24L0 -32L3.5 -24ZM-24 -3.5L-32 0L-24 3.5Z"/>'
    '<text stroke="none" x="-2" y="-36" text-anchor="middle">front</text>'
    '<text stroke="none" x="-34" y="3.5" text-anchor="end">left</text></g>'
)
