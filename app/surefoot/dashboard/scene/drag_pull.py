"""Shift-drag a link: the link itself is taken, and the spring that pulls it is drawn."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import viser
import viser.transforms as vtf

from surefoot.dashboard.messages.commands import Command, HoldLink, LetGo
from surefoot.dashboard.ui import palette
from surefoot.experiments.runs.saved_world import force_scale
from surefoot.robot.description import RobotDescription

_MOST_PULLS = 8
_UNSEEN_M = -5.0
_CONFIRM_EVERY = 15  # frames: a hand that is kept still is no hand that has left


class Grip:
    """The springs by which people pull links, and the forces in them.

    Args:
        server: where to draw.
        send: takes the commands.
        robot: whose weight makes the arrows' lengths.
    """

    def __init__(self, server: viser.ViserServer, send: Callable[[Command], None], robot: RobotDescription) -> None:
        self._send = send
        self.change_robot(robot)
        self._springs = server.scene.add_line_segments(
            "/grip/springs", np.zeros((_MOST_PULLS, 2, 3)), palette.PREVIEW, thickness=2.0, thickness_units="screen"
        )
        self._arrows = server.scene.add_arrows(
            "/grip/forces", _parked(), palette.FORCE, shaft_radius=0.008, head_radius=0.02, head_length=0.05
        )
        self._drawn: np.ndarray | None = None
        self._held: dict[int, HoldLink] = {}  # client -> what it holds
        self._frames = 0

    def change_robot(self, robot: RobotDescription) -> None:
        """The arrows are another robot's from now on."""
        self._metres_per_newton = force_scale(robot)

    def let_drag(self, node: viser.GlbHandle, link: str) -> None:
        """Let people take hold of a link by the node that shows it, which has the link's axes."""
        held = self._held

        @node.on_drag("left", modifier="shift")
        async def _(event: viser.SceneNodeDragEvent) -> None:  # async: start, updates and end stay in order
            client_id = event.client.client_id
            if event.phase == "end":  # also when the client leaves
                if held.pop(client_id, None) is not None:
                    self._send(LetGo(str(client_id)))
                return
            if event.phase == "start":
                point = in_axes_of(node, np.array(event.start_position))
                held[client_id] = HoldLink(
                    client_id=str(client_id), link=link, point=tuple(point.tolist()), target=event.end_position
                )
            if client_id in held:  # of later events only the end counts: the link has moved since
                held[client_id] = replace(held[client_id], target=event.end_position)
                self._send(held[client_id])

    def update(self, pulls: np.ndarray) -> None:
        """Draw the pulls.

        Args:
            pulls: (n, 9) held point, hand, force [N].
        """
        self._draw(pulls)
        self._frames += 1
        if self._frames % _CONFIRM_EVERY == 0:
            for hold in tuple(self._held.values()):
                self._send(hold)

    def _draw(self, pulls: np.ndarray) -> None:
        if self._drawn is not None and np.array_equal(pulls, self._drawn):
            return
        self._drawn = pulls
        springs, arrows = _parked(), _parked()
        for i, row in enumerate(pulls[:_MOST_PULLS]):
            springs[i] = row[:3], row[3:6]
            arrows[i] = row[:3], row[:3] + self._metres_per_newton * row[6:9] + (0.0, 0.0, 1e-4)
        self._springs.points, self._arrows.points = springs.astype(np.float32), arrows.astype(np.float32)


def in_axes_of(node: viser.SceneNodeHandle, point: np.ndarray) -> np.ndarray:
    """A point (3,) of the world in the axes of a node that hangs below an unmoved one."""
    return vtf.SO3(node.wxyz).inverse().apply(point - node.position)


def _parked() -> np.ndarray:
    points = np.zeros((_MOST_PULLS, 2, 3))
    points[:, :, 2] = _UNSEEN_M
    points[:, 1, 2] += 1e-4  # an arrow without length has no direction
    return points
