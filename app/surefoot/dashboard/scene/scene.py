"""One world in the browser: robot and stones, the ground below them, and the light."""

from collections.abc import Callable
from functools import partial

import viser

from surefoot.dashboard.messages.commands import Command
from surefoot.dashboard.messages.shown_robot import view_scale
from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.believed import BelievedView
from surefoot.dashboard.scene.ground import GroundBlocks, GroundView
from surefoot.dashboard.scene.light import Light
from surefoot.dashboard.scene.robot import SEE_THROUGH, RobotView
from surefoot.dashboard.scene.stones import StonesView
from surefoot.dashboard.ui import palette
from surefoot.robot.description import RobotDescription
from surefoot.simulation.terrain import Terrain

__all__ = ["CAMERA_FOV_RAD", "CAMERA_LOOK_AT", "CAMERA_POSITION", "SEE_THROUGH", "WHOLE_ROBOT", "SceneView"]

CAMERA_POSITION = (2.25, 1.85, 1.55)
CAMERA_LOOK_AT = (0.0, 0.06, 0.8)
WHOLE_ROBOT = (CAMERA_POSITION, CAMERA_LOOK_AT)
CAMERA_FOV_RAD = 0.75


class SceneView:
    """Robot, stones and ground of one run; a second one gets another prefix, and no grid of its own.

    Args:
        server: where to draw.
        robot: whose shapes to draw.
        prefix: name of the node below which everything hangs.
        offset: where the world's origin is drawn (3,) [m].
        tint: colour that the robot's own are mixed with.
        opacity: of the robot.
        ground: draw the ground's plane too, and look at it all from the usual place.
        blocks: draw what stands on the ground from the start, as a ``ground`` does anyway.
        believed: draw the robot as an estimator has it, where there is one.
        send: takes what a person does with the stones; None: nothing.
        let_drag: is given each link's node and name, to let people take hold of it; None: nobody can.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        robot: RobotDescription,
        *,
        prefix: str = "/world",
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
        tint: palette.Rgb | None = None,
        opacity: float = 1.0,
        ground: bool = True,
        blocks: bool = True,
        believed: bool = True,
        send: Callable[[Command], None] | None = None,
        let_drag: Callable[[viser.GlbHandle, str], None] | None = None,
    ) -> None:
        self._server = server
        self._root = server.scene.add_frame(prefix, show_axes=False, position=offset)
        self._make = partial(RobotView, server, root=f"{prefix}/robot", tint=tint, opacity=opacity, let_drag=let_drag)
        self._robot = self._make(robot)
        self._believed = BelievedView(server, robot, f"{prefix}/believed") if believed else None
        self._stones = StonesView(server, f"{prefix}/stones", send)
        self._grid = GroundView(server, f"{prefix}/ground") if ground else None
        self._ground = self._grid or (GroundBlocks(server, f"{prefix}/ground") if blocks else None)
        self._light = Light(server) if ground else None
        if ground:
            camera = server.initial_camera
            camera.fov = CAMERA_FOV_RAD
            self._set_first_camera(robot)

    def change_robot(self, robot: RobotDescription) -> None:
        """Draw another robot from now on."""
        part, dark = self._robot.part_seen_through, self._robot.on_dark_page
        self._robot.remove()
        self._robot = self._make(robot)
        self._robot.set_dark(dark)
        self._robot.see_through(part)
        if self._believed is not None:
            self._believed.change_robot(robot)
        if self._grid is not None:
            self._set_first_camera(robot)

    def remove(self) -> None:
        """Take all of it away."""
        self._root.remove()

    def _set_first_camera(self, robot: RobotDescription) -> None:
        scale, camera = view_scale(robot), self._server.initial_camera
        for name, point in (("position", CAMERA_POSITION), ("look_at", CAMERA_LOOK_AT)):
            setattr(camera, name, (scale * point[0], scale * point[1], scale * point[2]))

    def see_through(self, part: str) -> None:
        """Make the feet, the whole robot or nothing see-through: one of ``SEE_THROUGH``."""
        self._robot.see_through(part)

    def show_believed(self, visible: bool) -> None:
        """Show or hide the robot as an estimator has it."""
        if self._believed is not None:
            self._believed.shown = visible

    def set_dark(self, dark: bool) -> None:
        """Colours of the ground, and of what is see-through, for a dark or a light page."""
        self._robot.set_dark(dark)
        if self._grid is not None:
            self._grid.set_dark(dark)

    def set_visible(self, visible: bool) -> None:
        """Show or hide all of it."""
        self._root.visible = visible

    def move_to(self, offset: tuple[float, float, float]) -> None:
        """Draw the world's origin elsewhere (3,) [m]."""
        self._root.position = offset

    def show_terrain(self, terrain: Terrain) -> None:
        """Draw what stands on the ground from the start, where that is wanted."""
        if self._ground is not None:
            self._ground.show_terrain(terrain)

    def update(self, geometry: Geometry) -> None:
        """Move everything to where it is."""
        if self._ground is not None:
            self._ground.update(geometry)
        if self._light is not None:
            self._light.follow(geometry.com + self._root.position)
        if self._root.visible:
            self._stones.draw(geometry.stones)
            self._robot.update(geometry.qpos)
            if self._believed is not None:
                self._believed.update(geometry.believed)
