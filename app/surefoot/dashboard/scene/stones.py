"""Stones in the browser: their meshes, placed from snapshots; a person can drag them."""

from collections.abc import Callable
from typing import Any

import numpy as np
import viser

from surefoot.dashboard.messages.commands import Command, MoveStone
from surefoot.dashboard.messages.stone_view import StoneView
from surefoot.dashboard.scene.click_to_place import ray_to_ground
from surefoot.dashboard.ui import palette
from surefoot.simulation.stones import BOX, HALF_BALL, POOL_SIZE, WEDGE, Stone

Mesh = tuple[np.ndarray, np.ndarray]
_MOST_CORNERS = 6  # of a cube's face once a plane has cut it, and one more
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def cube() -> Mesh:
    """Vertices and faces of a cube of edge 1 about the origin."""
    corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    return corners, np.array([face for a, b, c, d in _SIDES for face in ((a, b, c), (a, c, d))])


def half_ball(rings: int = 10, sides: int = 28) -> Mesh:
    """Vertices and faces of the upper half of a ball of diameter 1 about the origin."""
    polar = np.linspace(0.0, 0.5 * np.pi, rings + 1)
    around = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    vertices = np.array(
        [(0.5 * np.sin(p) * np.cos(a), 0.5 * np.sin(p) * np.sin(a), 0.5 * np.cos(p)) for p in polar for a in around]
    )
    faces = []
    for i in range(rings):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            faces += [(a, a + sides, b + sides), (a, b + sides, b)]
    return vertices, np.array(faces)


def wedge(stone: Stone, top_m: float) -> Mesh:
    """What the ground leaves of a wedge whose highest point is that high: always as many vertices and faces.

    In the ground's axes, from the ground's point below the middle of its top [m].
    """
    half, R = stone.half_lengths(), stone.rotation()
    middle = np.array((0.0, 0.0, top_m - float(np.abs(R[2, :2]).dot(half[:2])))) - R[:, 2] * half[2]
    corners = middle + (2.0 * half * cube()[0]).dot(R.T)
    floor = max(0.0, top_m - stone.height_m)  # one that drops is as thick as it will be
    rows = []
    for side in _SIDES:
        cut = _above([corners[i] for i in side], floor)
        rows += [*cut, *[cut[-1]] * (_MOST_CORNERS - len(cut))]
    fans = [(6 * face, 6 * face + i, 6 * face + i + 1) for face in range(len(_SIDES)) for i in range(1, 5)]
    return np.array(rows), np.array(fans)


def _above(polygon: list[np.ndarray], floor: float) -> list[np.ndarray]:
    """The part of a convex polygon above a height; one point where there is none."""
    kept = []
    for here, there in zip(polygon, [*polygon[1:], polygon[0]], strict=True):
        inside, next_inside = here[2] >= floor, there[2] >= floor
        if inside:
            kept.append(here)
        if inside != next_inside:
            kept.append(here + (floor - here[2]) / (there[2] - here[2]) * (there - here))
    return kept or [np.array((*polygon[0][:2], floor))]


_UNSEEN = np.array((0.0, 0.0, -5.0))
_WEDGE = (196, 180, 156)  # as a batch shows palette.STONE: it takes its colours for brighter
_UPRIGHT = np.array((1.0, 0.0, 0.0, 0.0))


class StonesView:
    """All stones.

    Args:
        server: where to draw.
        name: of the node below which they hang.
        send: takes the command of a stone that is dragged; None: they cannot be.
    """

    def __init__(
        self, server: viser.ViserServer, name: str = "/stones", send: Callable[[Command], None] | None = None
    ) -> None:
        self.node = server.scene.add_frame(name, show_axes=False)
        self._drawn: tuple[StoneView, ...] | None = None
        self._batches = {
            BOX: _Batch(server, f"{name}/boxes", cube(), flat=True, send=send),
            HALF_BALL: _Batch(server, f"{name}/balls", half_ball(), flat=False, send=send),
        }
        self._wedges = _Wedges(server, name, send)

    def draw(self, stones: tuple[StoneView, ...]) -> None:
        """Move everything to where it is."""
        if stones == self._drawn:
            return
        self._drawn = stones
        for shape, batch in self._batches.items():
            batch.update([view for view in stones if view.stone.shape == shape])
        self._wedges.update([view for view in stones if view.stone.shape == WEDGE])


class _Batch:
    """Stones of one mesh."""

    def __init__(
        self,
        server: viser.ViserServer,
        name: str,
        mesh: tuple[np.ndarray, np.ndarray],
        *,
        flat: bool,
        send: Callable[[Command], None] | None,
    ) -> None:
        self._shown: list[StoneView] = []
        self._node = server.scene.add_batched_meshes_simple(
            name,
            *mesh,
            batched_wxyzs=np.tile(_UPRIGHT, (POOL_SIZE, 1)),
            batched_positions=np.tile(_UNSEEN, (POOL_SIZE, 1)),
            batched_scales=np.full((POOL_SIZE, 3), 0.01),
            batched_colors=palette.STONE,
            flat_shading=flat,
            lod="off",
            side="double",
        )
        if send is not None:
            let_drag(self._node, self._taken, send)

    def update(self, stones: list[StoneView]) -> None:
        self._shown = stones
        positions, scales = np.tile(_UNSEEN, (POOL_SIZE, 1)), np.full((POOL_SIZE, 3), 0.01)
        turns = np.tile(_UPRIGHT, (POOL_SIZE, 1))
        for i, view in enumerate(stones[:POOL_SIZE]):
            positions[i], scales[i], turns[i] = view.position, view.lengths, view.wxyz
        self._node.batched_positions, self._node.batched_scales = positions, scales
        self._node.batched_wxyzs = turns

    def _taken(self, event: viser.SceneNodeDragEvent) -> StoneView | None:
        index = event.instance_index
        return self._shown[index] if index is not None and index < len(self._shown) else None


class _Wedges:
    """Wedges: each has a mesh of its own, cut where the ground is."""

    def __init__(self, server: viser.ViserServer, name: str, send: Callable[[Command], None] | None) -> None:
        self._server, self._name, self._send = server, name, send
        self._nodes: dict[int, viser.MeshHandle] = {}
        self._shown: dict[int, StoneView] = {}

    def update(self, stones: list[StoneView]) -> None:
        shown = {view.number: view for view in stones}
        for number in self._nodes.keys() - shown.keys():
            self._nodes.pop(number).remove()
        for number, view in shown.items():
            before = self._shown.get(number)
            if number not in self._nodes:
                self._nodes[number] = self._made(view)
            elif before is None or (before.stone, before.top_m) != (view.stone, view.top_m):
                self._nodes[number].vertices = wedge(view.stone, view.top_m)[0].astype(np.float32)
            self._nodes[number].position, self._nodes[number].wxyz = view.position, view.wxyz
        self._shown = shown

    def _made(self, view: StoneView) -> viser.MeshHandle:
        name = f"{self._name}/wedge_{view.number}"
        node = self._server.scene.add_mesh_simple(
            name, *wedge(view.stone, view.top_m), color=_WEDGE, flat_shading=True, side="double"
        )
        if self._send is not None:
            let_drag(node, lambda event, number=view.number: self._shown.get(number), self._send)
        return node


def let_drag(
    node: Any, which: Callable[[viser.SceneNodeDragEvent], StoneView | None], send: Callable[[Command], None]
) -> None:
    """Let a person drag a stone over the ground."""
    held: dict[int, tuple[int, np.ndarray]] = {}  # client -> stone's number, its centre less where it was taken

    @node.on_drag("left")
    async def _(event: viser.SceneNodeDragEvent) -> None:  # async: start, updates and end stay in order
        client, eye = event.client.client_id, np.array(event.client.camera.position)
        if event.phase == "end":
            held.pop(client, None)
            return
        if event.phase == "start" and (view := which(event)) is not None:
            taken = ray_to_ground(eye, np.array(event.start_position))
            if taken is not None:
                held[client] = (view.number, np.array((view.stone.x_m, view.stone.y_m)) - taken)
        place = ray_to_ground(eye, np.array(event.end_position))
        if client in held and place is not None:
            number, offset = held[client]
            x, y = (place + offset).tolist()
            send(MoveStone(number=number, x_m=x, y_m=y))
