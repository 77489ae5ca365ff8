"""The robot as an estimator has it: a translucent ghost over the true one."""

import viser

from surefoot.dashboard.messages.believed import BelievedRobot
from surefoot.dashboard.scene.robot import RobotView
from surefoot.dashboard.ui import palette
from surefoot.robot.description import RobotDescription

_OPACITY = 0.35


class BelievedView:
    """The ghost; its shapes are made when one is first seen.

    Args:
        server: where to draw.
        robot: whose shapes to draw.
        root: name of the node below which everything hangs.

    Attributes:
        shown: whether it is wanted.
    """

    def __init__(self, server: viser.ViserServer, robot: RobotDescription, root: str) -> None:
        self._server, self._robot, self._root = server, robot, root
        self._frame = server.scene.add_frame(root, show_axes=False, visible=False)
        self._view: RobotView | None = None
        self.shown = True

    def change_robot(self, robot: RobotDescription) -> None:
        """Draw another robot from now on."""
        self._robot = robot
        if self._view is not None:
            self._view.remove()
            self._view = None

    def update(self, believed: BelievedRobot | None) -> None:
        """Move it to where the robot is believed to be; hide it where nobody believes anything."""
        visible = self.shown and believed is not None
        self._frame.visible = visible
        if believed is None or not visible:
            return
        if self._view is None:
            self._view = RobotView(
                self._server, self._robot, f"{self._root}/robot", tint=palette.BELIEVED, opacity=_OPACITY
            )
        self._view.update(believed.qpos)
