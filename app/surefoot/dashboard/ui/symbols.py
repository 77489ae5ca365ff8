"""The points of the theory: how each is drawn, the same in the plan of the feet, in the legend and in the scene."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.ui import palette

_HALO = 'stroke="#fff" stroke-opacity="0.85" stroke-width="1"'


@dataclass(frozen=True, kw_only=True)
class PointSymbol:
    """A point that the plan of the feet shows.

    Attributes:
        key: its name in code.
        name: beside its coordinates.
        help: one line.
        colour: out of the palette.
        svg: its sign about the origin [pixels]; ``{at}``, ``{colour}`` and ``{halo}`` stand for these attributes.
        place: (2,) where it is, world [m]; NaN where unknown.
        trail_column: where its x stands in ``Geometry.trail``, y behind it; None for a point without a trail.
        layer: of two signs at one place, the one of the higher layer is seen.
    """

    key: str
    name: str
    help: str
    colour: palette.Rgb
    svg: str
    place: Callable[[Geometry], np.ndarray]
    trail_column: int | None
    layer: int

    def trail(self, geometry: Geometry) -> np.ndarray:
        """(n, 2) where it was, oldest first, world [m]; (0, 2) for a point without a trail."""
        if self.trail_column is None:
            return np.empty((0, 2))
        return geometry.trail[:, self.trail_column : self.trail_column + 2]


ZMP = PointSymbol(
    key="zmp",
    name="ZMP",
    help="measured centre of pressure of the ground's forces",
    colour=palette.ZMP_MEASURED,
    svg='<circle {at} r="5" fill="{colour}" {halo}/>',
    place=lambda geometry: geometry.zmp_measured,
    trail_column=0,
    layer=3,
)
ZMP_COMMANDED = PointSymbol(
    key="command",
    name="ZMP commanded ζ",
    help="where the controller wants the ZMP, after margin and guard",
    colour=palette.ZMP_COMMANDED,
    svg='<circle {at} r="8" fill="none" stroke="{colour}" stroke-width="2.6"/>',
    place=lambda geometry: geometry.zmp_commanded,
    trail_column=None,
    layer=2,
)
COM = PointSymbol(
    key="com",
    name="CoM",
    help="the point of the ground below the centre of mass",
    colour=palette.COM,
    svg='<g {at}><circle r="6" fill="#fff"/><path d="M0 0V-6A6 6 0 0 1 6 0ZM0 0V6A6 6 0 0 1 -6 0Z" fill="{colour}"/>'
    '<circle r="6" fill="none" stroke="{colour}" stroke-width="1.6"/></g>',
    place=lambda geometry: geometry.com[:2],
    trail_column=2,
    layer=0,
)
CAPTURE = PointSymbol(
    key="capture",
    name="DCM",
    help="capture point: CoM + velocity / ω; once outside the polygon balance is lost",
    colour=palette.CAPTURE,
    svg='<path {at} d="M0 -6.5L6.5 0L0 6.5L-6.5 0Z" fill="{colour}" {halo}/>',
    place=lambda geometry: geometry.capture,
    trail_column=4,
    layer=1,
)
POINTS = (ZMP, ZMP_COMMANDED, COM, CAPTURE)  # in the order of their rows
BY_KEY = {point.key: point for point in POINTS}
FROM_BELOW = tuple(sorted(POINTS, key=lambda point: point.layer))  # in the order in which they are drawn


def mark(point: PointSymbol, x: float, y: float) -> str:
    """SVG of a point's sign at a place [pixels]."""
    at = f'transform="translate({x:.1f} {y:.1f})"'
    return point.svg.format(at=at, colour=palette.css(point.colour), halo=_HALO)


def sign(point: PointSymbol, size: int = 18) -> str:
    """The sign alone, to stand in a line of text."""
    return (
        f'<svg width="{size}" height="{size}" viewBox="-10 -10 20 20" style="vertical-align:-4px;flex:none">'
        f"{mark(point, 0.0, 0.0)}</svg>"
    )
