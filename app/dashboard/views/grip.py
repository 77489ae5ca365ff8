"""Shift-drag a link: an invisible box around each link can be taken, and the spring that pulls it is drawn."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import viser

from app.dashboard import palette
from app.dashboard.commands import Command, HoldLink, LetGo
from app.dashboard.views.stone_shapes import cube

_MOST_PULLS = 8
_METRES_PER_NEWTON = 0.0012
_UNSEEN_M = -5.0
_CONFIRM_EVERY = 15  # frames: a hand that is kept still is no hand that has left


@dataclass(frozen=True)
class LinkBox:
    """The box around a link's shapes.

    Attributes:
        name: of the link.
        body: its number in the poses given to ``Grip.update``.
        centre, lengths: (3,) in the link's axes [m].
    """

    name: str
    body: int
    centre: np.ndarray
    lengths: np.ndarray


class Grip:
    """Links that can be pulled, and the pulls.

    Args:
        server: where to draw.
        boxes: one per link.
        send: takes the commands.
    """

    def __init__(self, server: viser.ViserServer, boxes: Sequence[LinkBox], send: Callable[[Command], None]) -> None:
        self._boxes, self._send = tuple(boxes), send
        self._bodies = [box.body for box in boxes]
        self._poses: tuple[np.ndarray, np.ndarray] = (np.zeros((len(boxes), 3)), np.zeros((len(boxes), 3, 3)))
        count = len(boxes)
        # wires, because a surface that is not seen still hides what is see-through behind it
        self._node = server.scene.add_batched_meshes_simple(
            "/grip/links", *cube(), batched_wxyzs=np.tile((1.0, 0.0, 0.0, 0.0), (count, 1)),
            batched_positions=np.tile((0.0, 0.0, _UNSEEN_M), (count, 1)),
            batched_scales=np.array([box.lengths for box in boxes]), opacity=0.0, wireframe=True, lod="off",
            cast_shadow=False, receive_shadow=False,
        )  # fmt: skip
        self._springs = server.scene.add_line_segments(
            "/grip/springs", np.zeros((_MOST_PULLS, 2, 3)), palette.PREVIEW, thickness=2.0, thickness_units="screen"
        )
        self._arrows = server.scene.add_arrows(
            "/grip/forces", _parked(), palette.FORCE, shaft_radius=0.008, head_radius=0.02, head_length=0.05
        )
        self._drawn: np.ndarray | None = None
        self._held: dict[int, HoldLink] = {}  # client -> what it holds
        self._frames = 0
        self._let_drag()

    def update(self, positions: np.ndarray, quaternions: np.ndarray, rotations: np.ndarray, pulls: np.ndarray) -> None:
        """Move everything to where it is.

        Args:
            positions: of all bodies (n, 3) in world.
            quaternions: of the same (n, 4), w first.
            rotations: the same as matrices (n, 9).
            pulls: (n, 9) held point, hand, force [N].
        """
        turns = rotations[self._bodies].reshape(-1, 3, 3)
        places = positions[self._bodies]
        self._poses = (places.copy(), turns.copy())
        centres = np.array([box.centre for box in self._boxes])
        self._node.batched_positions = (places + np.einsum("nij,nj->ni", turns, centres)).astype(np.float32)
        self._node.batched_wxyzs = quaternions[self._bodies].astype(np.float32)
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
            arrows[i] = row[:3], row[:3] + _METRES_PER_NEWTON * row[6:9] + (0.0, 0.0, 1e-4)
        self._springs.points, self._arrows.points = springs.astype(np.float32), arrows.astype(np.float32)

    def _let_drag(self) -> None:
        held = self._held

        @self._node.on_drag("left", modifier="shift")
        async def _(event: viser.SceneNodeDragEvent) -> None:  # async: start, updates and end stay in order
            who, index = event.client.client_id, event.instance_index
            if event.phase == "end":  # also when the client leaves
                if held.pop(who, None) is not None:
                    self._send(LetGo(str(who)))
                return
            if event.phase == "start" and index is not None and index < len(self._boxes):
                places, turns = self._poses
                point = turns[index].T.dot(np.array(event.start_position) - places[index])
                held[who] = HoldLink(
                    who=str(who), link=self._boxes[index].name, point=tuple(point.tolist()), target=event.end_position
                )
            if who in held:  # of later events only the end counts: the link has moved since
                before = held[who]
                held[who] = HoldLink(who=before.who, link=before.link, point=before.point, target=event.end_position)
                self._send(held[who])


def _parked() -> np.ndarray:
    points = np.zeros((_MOST_PULLS, 2, 3))
    points[:, :, 2] = _UNSEEN_M
    points[:, 1, 2] += 1e-4  # an arrow without length has no direction
    return points
