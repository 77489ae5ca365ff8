"""What every marker has: a description for the page, nodes that are made once, and a way to move them."""

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
import viser

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import Part, glowing_glb
from surefoot.dashboard.scene.markers.support_plane import LIFT_M, SupportPlane, drawable
from surefoot.dashboard.scene.node_mover import NodeMover
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.symbols import PointSymbol
from surefoot.robot.description import RobotDescription


class Canvas:
    """Where markers make their nodes, and what moves them.

    Args:
        scene: where to draw.
        prefix: name of the node below which everything hangs.
        robot: whose markers they are.
    """

    def __init__(self, scene: viser.SceneApi, prefix: str, robot: RobotDescription) -> None:
        self.scene, self.prefix, self.robot = scene, prefix, robot
        self.mover = NodeMover()

    def sign(self, name: str, *parts: Part) -> viser.GlbHandle:
        """A node of meshes that have one colour in any light."""
        return self.scene.add_glb(f"{self.prefix}/{name}", glowing_glb(parts), cast_shadow=False, receive_shadow=False)

    def lines(self, name: str, count: int, colour: palette.Rgb, width: float) -> viser.LineSegmentsHandle:
        """A node of ``count`` line segments, ``width`` pixels wide."""
        return self.scene.add_line_segments(
            f"{self.prefix}/{name}", np.zeros((count, 2, 3)), colour, thickness=width, thickness_units="screen"
        )

    def put(self, node: viser.SceneNodeHandle, place: np.ndarray, plane: SupportPlane, lift_m: float) -> None:
        """Lay a node flat on a plane at a place (2,) in world [m], a little lifted."""
        self.mover.set(node, "position", plane.point(place) + (LIFT_M + lift_m) * plane.up)
        self.mover.set(node, "wxyz", plane.wxyz)


class Marker(ABC):
    """One thing that can be shown or hidden. Making it makes its nodes.

    Args:
        canvas: where to draw.

    Attributes:
        key: its name in code.
        label: what the page calls it.
        symbol: how it looks, for the legend.
        colour: out of the palette.
        help: one line.
        update_every: it is moved at each so many updates of the scene.
        shown_at_first: whether it is wanted until somebody says otherwise.
        shown: whether it is wanted.
    """

    key: ClassVar[str]
    label: ClassVar[str]
    symbol: ClassVar[str]
    colour: ClassVar[palette.Rgb]
    help: ClassVar[str]
    update_every: ClassVar[int] = 1
    shown_at_first: ClassVar[bool] = True

    def __init__(self, canvas: Canvas) -> None:
        self._canvas = canvas
        self.shown = self.shown_at_first
        self.create(canvas)

    @abstractmethod
    def create(self, canvas: Canvas) -> None:
        """Make the nodes."""

    @abstractmethod
    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Move them to where the thing is, and hide them when it is not wanted or not known."""


class PointMarker(Marker):
    """A point of the theory: a small sign that lies on the ground.

    Attributes:
        point: which one.
        part: mesh and colour of the sign.
        lift_m: so far above the ground; of two signs at one place the higher one is seen.
    """

    point: ClassVar[PointSymbol]
    part: ClassVar[Part]
    lift_m: ClassVar[float]

    def create(self, canvas: Canvas) -> None:
        """Make the sign."""
        self._node = canvas.sign(self.key, self.part)

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Lay it where the point is."""
        place = self.point.place(geometry)
        known = drawable(place)
        self._node.visible = self.shown and known
        if known:
            self._canvas.put(self._node, place, plane, self.lift_m)
