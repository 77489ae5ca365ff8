"""In the plan of the feet: what the robot really stands on, and what the estimator takes it to stand on."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.panels.balance.foot_stones import Plan
from surefoot.dashboard.ui import palette
from surefoot.geometry.polygon import convex_hull

_CARRIES = 0.01  # of all forces: a contact point with less is none
_BESIDE_M, _BELOW_M = 0.005, 0.05  # a contact farther beside or below a sole is none of this foot
_CIRCLE, _DIAMOND = "M4 0A4 4 0 1 0 4 .01Z", "M0 -8L8 0L0 8L-8 0Z"
LEGEND = (
    '<div style="display:flex;gap:12px;opacity:0.85"><span title="hull of the points that carry load now">'
    f'<span style="color:{palette.css(palette.FORCE)}">▰</span> true contact patch</span>'
    '<span title="hull of the soles that are to stand, where the estimator has them; hollow signs: believed CoM, DCM">'
    f'<span style="color:{palette.css(palette.BELIEVED)}">▱</span> assumed support</span></div>'
)


def patches_svg(plan: Plan, geometry: Geometry) -> list[str]:
    """The contact patches where there is an estimator, which takes it for granted that a sole lies flat."""
    if geometry.believed is None:
        return []
    colour, parts = palette.css(palette.FORCE), []
    for points in contact_patches(geometry):
        if len(corners := hull(points)):
            parts.append(
                f'<polygon data-patch points="{_path(plan, corners)}" fill="{colour}" fill-opacity="0.3" '
                f'stroke="{colour}" stroke-width="1.2"/>'
            )
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.2" fill="{colour}"/>' for x, y in plan.points(points)]
    return parts


def believed_svg(plan: Plan, geometry: Geometry) -> list[str]:
    """Assumed support, believed CoM and capture point."""
    if (believed := geometry.believed) is None:
        return []
    line, parts = f'stroke="{palette.css(palette.BELIEVED)}" stroke-width="1.8"', []
    if len(corners := assumed_support(geometry)):
        parts.append(f'<polygon data-assumed points="{_path(plan, corners)}" {line} stroke-dasharray="6 4"/>')
    for shape, place in ((_CIRCLE, believed.com[:2]), (_DIAMOND, believed.capture)):
        if np.isfinite(place).all():
            ((x, y),) = plan.points(place[None, :])
            parts.append(f'<path d="{shape}" {line} transform="translate({x:.1f} {y:.1f})"/>')
    return parts


def contact_patches(geometry: Geometry) -> list[np.ndarray]:
    """Of each foot the points (n, 2) in world [m] at which the ground carries it."""
    contacts = geometry.contacts[np.isfinite(geometry.contacts).all(axis=1)]
    forces = np.linalg.norm(contacts[:, 3:], axis=1)
    points = contacts[forces > _CARRIES * forces.sum(), :3]
    patches = []
    for sole in geometry.soles:
        near = points[np.abs(points[:, 2] - sole[:, 2].mean()) < _BELOW_M, :2]
        outline = hull(sole[:, :2])
        if not len(outline):  # on edge
            patches.append(np.empty((0, 2)))
            continue
        polygon = convex_hull(outline.tolist())
        patches.append(near[[polygon.signed_margin(point) > -_BESIDE_M for point in near]])
    return patches


def assumed_support(geometry: Geometry) -> np.ndarray:
    """Corners (n, 2) of the hull of the soles that are to stand, where they are believed to be, in world [m]."""
    believed = geometry.believed
    if believed is None or not geometry.standing:
        return np.empty((0, 2))
    return hull(np.vstack([believed.soles[i] for i in geometry.standing])[:, :2])


def hull(points: np.ndarray) -> np.ndarray:
    """Corners of the hull of points (n, 2); none where they span no area."""
    if len(points) < 3 or not np.isfinite(points).all():
        return np.empty((0, 2))
    try:
        return convex_hull(points.tolist()).vertices
    except ValueError:
        return np.empty((0, 2))


def _path(plan: Plan, places: np.ndarray) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in plan.points(places))
