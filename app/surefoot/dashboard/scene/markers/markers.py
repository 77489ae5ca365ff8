"""All markers of the scene: shown, hidden and moved together."""

import viser

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.markers.believed import BelievedMarker
from surefoot.dashboard.scene.markers.capture_regions import CaptureRegionsMarker
from surefoot.dashboard.scene.markers.com import ComMarker
from surefoot.dashboard.scene.markers.footprints import FootprintsMarker
from surefoot.dashboard.scene.markers.forces import ForcesMarker
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.plan import PlanMarker
from surefoot.dashboard.scene.markers.points import CaptureMarker, ZmpCommandedMarker, ZmpMarker
from surefoot.dashboard.scene.markers.soles import SolesMarker, SupportPolygonMarker
from surefoot.dashboard.scene.markers.support_plane import SupportPlane
from surefoot.dashboard.scene.markers.trails import TrailsMarker
from surefoot.robot.description import RobotDescription

MARKERS: tuple[type[Marker], ...] = (
    SupportPolygonMarker,
    SolesMarker,
    FootprintsMarker,
    PlanMarker,
    CaptureRegionsMarker,
    ZmpMarker,
    ZmpCommandedMarker,
    ComMarker,
    CaptureMarker,
    BelievedMarker,
    ForcesMarker,
    TrailsMarker,
)


class Markers:
    """Every node is made once and then only moved.

    Args:
        server: where to draw.
        robot: whose.
        prefix: name of the node below which everything hangs.
        offset: where the world's origin is drawn (3,) [m].
    """

    def __init__(
        self,
        server: viser.ViserServer,
        robot: RobotDescription,
        *,
        prefix: str = "/overlay",
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        self._root = server.scene.add_frame(prefix, show_axes=False, position=offset)
        canvas = self._canvas = Canvas(server.scene, prefix, robot)
        self._markers = {kind.key: kind(canvas) for kind in MARKERS}
        self._updates = 0

    def change_robot(self, robot: RobotDescription) -> None:
        """Mark another robot from now on."""
        self._canvas.robot = robot

    def show(self, key: str, visible: bool) -> None:
        """Show or hide one marker."""
        self._markers[key].shown = visible

    def set_visible(self, visible: bool) -> None:
        """Show or hide all of them."""
        self._root.visible = visible

    def move_to(self, offset: tuple[float, float, float]) -> None:
        """Draw the world's origin elsewhere (3,) [m]."""
        self._root.position = offset

    def update(self, geometry: Geometry) -> None:
        """Move everything to where it is."""
        if not self._root.visible:
            return
        plane = SupportPlane(geometry)
        self._updates += 1
        for marker in self._markers.values():
            if self._updates % marker.update_every == 0:
                marker.update(geometry, plane)
