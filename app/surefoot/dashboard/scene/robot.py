"""A robot in the browser: a mesh for each link, placed from joint angles. The only view that knows MuJoCo."""

from collections.abc import Callable

import mujoco
import numpy as np
import viser

from surefoot.dashboard.scene.link_meshes import link_glb
from surefoot.dashboard.scene.node_mover import NodeMover
from surefoot.dashboard.ui import palette
from surefoot.robot.description import RobotDescription

SEE_THROUGH = (FEET, ROBOT, NOTHING) = ("feet", "whole robot", "nothing")
_GHOST_COLOUR, _GHOST_OPACITY = (150, 158, 166), 0.22
_HIDDEN_GROUP = 3  # geoms of this group and above are not drawn: soles and collision shapes


class RobotView:
    """One robot; every link is a node that is made once and then only moved.

    Args:
        server: where to draw.
        robot: whose shapes to draw; a model of the view's own, without a world.
        root: node below which everything hangs.
        tint: colour that its own are mixed with.
        opacity: of what is not see-through.
        let_drag: is given each link's node and name, to let people take hold of it; None: nobody can.
    """

    def __init__(
        self, server: viser.ViserServer, robot: RobotDescription, root: str, *, tint: palette.Rgb | None = None,
        opacity: float = 1.0, let_drag: Callable[[viser.GlbHandle, str], None] | None = None,
    ) -> None:  # fmt: skip
        self._let_drag = let_drag
        self._server, self._root, self._tint, self._opacity = server, root, tint, opacity
        self._model = mujoco.MjModel.from_xml_path(str(robot.mjcf_path))
        self._data = mujoco.MjData(self._model)
        self._links = _links(self._model)
        self._feet = {self._model.body(foot.body).id for foot in robot.feet}
        self._solid: dict[int, viser.GlbHandle] = {}
        self._ghost: dict[int, viser.GlbHandle] = {}
        self._shown: tuple[list[int], list[viser.GlbHandle]] = ([], [])
        self._mover = NodeMover()
        self.see_through(FEET)

    def see_through(self, part: str) -> None:
        """Make the feet, the whole robot or nothing see-through: one of ``SEE_THROUGH``."""
        ghosts = {FEET: self._feet, ROBOT: set(self._links)}.get(part, set())
        bodies, nodes = [], []
        for body in self._links:
            wanted, other = (self._ghost, self._solid) if body in ghosts else (self._solid, self._ghost)
            if body not in wanted:
                wanted[body] = self._made(body, ghost=body in ghosts)
            wanted[body].visible = True
            if body in other:
                other[body].visible = False
            bodies.append(body)
            nodes.append(wanted[body])
        self._shown = bodies, nodes  # in one step: the page's thread may be moving them; it places them next

    def update(self, qpos: np.ndarray) -> None:
        """Move it to where it is: MuJoCo's configuration (22,)."""
        if np.isfinite(qpos.sum()):
            self._data.qpos[:] = qpos
            mujoco.mj_kinematics(self._model, self._data)
            self._place()

    def _place(self) -> None:
        bodies, nodes = self._shown
        self._mover.place(nodes, self._data.xpos[bodies], self._data.xquat[bodies])

    def _made(self, body: int, *, ghost: bool) -> viser.GlbHandle:
        node = self._drawn(body, ghost=ghost)
        if self._let_drag is not None:
            self._let_drag(node, self._model.body(body).name)
        return node

    def _drawn(self, body: int, *, ghost: bool) -> viser.GlbHandle:
        name, geoms = f"{self._root}/{self._model.body(body).name}", self._links[body]
        if ghost:
            data = link_glb(self._model, geoms, tint=self._tint or _GHOST_COLOUR, mix=1.0,
                            opacity=min(self._opacity, _GHOST_OPACITY))  # fmt: skip
            return self._server.scene.add_glb(f"{name}_ghost", data, receive_shadow=False)
        data = link_glb(self._model, geoms, tint=self._tint, opacity=self._opacity)
        return self._server.scene.add_glb(name, data, receive_shadow=False)  # small parts: they would only flicker


def _links(model: mujoco.MjModel) -> dict[int, list[int]]:
    """Body -> its visible geoms."""
    found: dict[int, list[int]] = {}
    for geom in np.flatnonzero(model.geom_group < _HIDDEN_GROUP):
        found.setdefault(int(model.geom_bodyid[geom]), []).append(int(geom))
    return found
