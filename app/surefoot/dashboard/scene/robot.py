"""A robot in the browser: a mesh for each link, placed from joint angles. The only view that knows MuJoCo."""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import mujoco
import numpy as np
import trimesh
import viser
from mjviser.conversions import create_primitive_mesh, mujoco_mesh_to_trimesh
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

from surefoot.dashboard.scene.face_budgets import box_area, shared_faces
from surefoot.dashboard.scene.marker_meshes import linear
from surefoot.dashboard.scene.node_mover import NodeMover
from surefoot.dashboard.scene.simplify import simplified
from surefoot.dashboard.ui import palette
from surefoot.robot.description import RobotDescription

SEE_THROUGH = (FEET, ROBOT, NOTHING) = ("feet", "whole robot", "nothing")
# Of what is see-through, on a light and on a dark page: far from the ground's colour, so that a quarter of it is plain
_GHOST_COLOURS, _GHOST_OPACITY = {False: (55, 63, 75), True: (200, 206, 212)}, 0.25
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

    Attributes:
        part_seen_through: one of ``SEE_THROUGH``.
        on_dark_page: what the ghosts' colour is for.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        robot: RobotDescription,
        root: str,
        *,
        tint: palette.Rgb | None = None,
        opacity: float = 1.0,
        let_drag: Callable[[viser.GlbHandle, str], None] | None = None,
    ) -> None:
        self._let_drag = let_drag
        self._server, self._root, self._tint, self._opacity = server, root, tint, opacity
        self._model = robot_model(robot)
        self._data = mujoco.MjData(self._model)
        self._links = _links(self._model)
        self._feet = {self._model.body(foot.body).id for foot in robot.feet}
        self._solid: dict[int, viser.GlbHandle] = {}
        self._ghosts: dict[bool, dict[int, viser.GlbHandle]] = {dark: {} for dark in _GHOST_COLOURS}
        self._shown: tuple[list[int], list[viser.GlbHandle]] = ([], [])
        self._mover = NodeMover()
        self.part_seen_through, self.on_dark_page = FEET, False
        self.see_through(FEET)

    def see_through(self, part: str) -> None:
        """Make the feet, the whole robot or nothing see-through: one of ``SEE_THROUGH``."""
        self.part_seen_through = part
        ghosts = {FEET: self._feet, ROBOT: set(self._links)}.get(part, set())
        bodies, nodes = [], []
        for body in self._links:
            wanted = self._ghosts[self.on_dark_page] if body in ghosts else self._solid
            if body not in wanted:
                wanted[body] = self._made(body, ghost=body in ghosts)
            wanted[body].visible = True
            for other in (self._solid, *self._ghosts.values()):
                if other is not wanted and body in other:
                    other[body].visible = False
            bodies.append(body)
            nodes.append(wanted[body])
        self._shown = bodies, nodes  # in one step: the page's thread may be moving them; it places them next

    def set_dark(self, dark: bool) -> None:
        """Colour of what is see-through, for a dark or a light page."""
        if dark != self.on_dark_page:
            self.on_dark_page = dark
            self.see_through(self.part_seen_through)

    def remove(self) -> None:
        """Take its nodes away."""
        self._shown = [], []
        for nodes in (self._solid, *self._ghosts.values()):
            for node in nodes.values():
                node.remove()

    def update(self, qpos: np.ndarray) -> None:
        """Move it to where it is: MuJoCo's configuration (7 + n,)."""
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
            data = link_glb(
                self._model,
                geoms,
                tint=self._tint or _GHOST_COLOURS[self.on_dark_page],
                mix=1.0,
                opacity=min(self._opacity, _GHOST_OPACITY),
            )
            name += "_ghost_on_dark" if self.on_dark_page else "_ghost"
            return self._server.scene.add_glb(name, data, receive_shadow=False)
        data = link_glb(self._model, geoms, tint=self._tint, opacity=self._opacity)
        return self._server.scene.add_glb(name, data, receive_shadow=False)  # small parts: they would only flicker


@lru_cache(maxsize=2)
def robot_model(robot: RobotDescription) -> mujoco.MjModel:
    """MuJoCo's model of a robot alone, which all its views share."""
    if robot.mjcf_xml is None:
        return mujoco.MjModel.from_xml_path(str(robot.mjcf_path))
    return mujoco.MjModel.from_xml_string(robot.mjcf_xml)


def _links(model: mujoco.MjModel) -> dict[int, list[int]]:
    """Body -> its visible geoms."""
    found: dict[int, list[int]] = {}
    for geom in np.flatnonzero(model.geom_group < _HIDDEN_GROUP):
        found.setdefault(int(model.geom_bodyid[geom]), []).append(int(geom))
    return found


_SMOOTH_RAD = 0.5  # faces that meet at less than this look like one round surface
_MOST_FACES = 30_000  # of all meshes of a robot, some 45 bytes each: 1.4 MB
_ROUGHNESS, _METALLIC = 0.7, 0.0  # of a material that says nothing


def link_glb(
    model: Any, geoms: Sequence[int], *, tint: palette.Rgb | None = None, mix: float = 0.65, opacity: float = 1.0
) -> bytes:
    """The geoms of one body as glTF in the body's axes, one mesh for each material or, without one, each colour.

    Args:
        model: MuJoCo's.
        geoms: numbers of the geoms.
        tint: colour that the materials' own are mixed with.
        mix: how much of it, 0 to 1.
        opacity: 0 to 1.
    """
    scene = trimesh.Scene()
    budgets = _face_budgets(model)
    alike: dict[tuple[int, tuple[float, ...]], list[int]] = {}
    for geom in geoms:
        alike.setdefault(_look(model, geom), []).append(geom)
    for number, (look, same) in enumerate(sorted(alike.items())):
        name = f"material_{look[0]}" if look[0] >= 0 else f"colour_{number}"
        mesh = _joined([_shape(model, geom, budgets.get(geom, 0)) for geom in same])
        mesh.visual = TextureVisuals(material=_material(model, look, tint, mix, opacity))
        scene.add_geometry(mesh, geom_name=name)
    data = scene.export(file_type="glb", include_normals=True)
    assert isinstance(data, bytes)
    return data


def _look(model: Any, geom: int) -> tuple[int, tuple[float, ...]]:
    """Number of the geom's material, -1 for none, and the red, green and blue of that or else its own."""
    number = int(model.geom_matid[geom])
    rgb = model.geom_rgba[geom, :3] if number < 0 else model.mat_rgba[number, :3]
    return number, tuple(rgb.tolist())


def _joined(parts: list[trimesh.Trimesh]) -> trimesh.Trimesh:
    first = np.cumsum([0, *(len(part.vertices) for part in parts)])
    faces = [part.faces + offset for part, offset in zip(parts, first, strict=False)]
    return trimesh.Trimesh(np.vstack([part.vertices for part in parts]), np.vstack(faces), process=False)


@lru_cache(maxsize=2)
def _face_budgets(model: Any) -> dict[int, int]:
    """How many faces each visible geom that is a mesh may have."""
    meshes = {geom: int(model.geom_dataid[geom]) for geoms in _links(model).values() for geom in geoms}
    meshes = {geom: mesh for geom, mesh in meshes.items() if mesh >= 0}
    faces = {geom: int(model.mesh_facenum[mesh]) for geom, mesh in meshes.items()}
    areas = {geom: box_area(_vertices(model, mesh)) for geom, mesh in meshes.items()}
    return shared_faces(faces, areas, _MOST_FACES)


def _vertices(model: Any, mesh: int) -> np.ndarray:
    first = int(model.mesh_vertadr[mesh])
    return model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])]


@lru_cache(maxsize=512)
def _shape(model: Any, geom: int, most_faces: int) -> trimesh.Trimesh:
    """One geom in its body's axes, its vertices split where an edge should be seen; not to be changed: it is kept."""
    if model.geom_dataid[geom] >= 0:
        whole = mujoco_mesh_to_trimesh(model, geom)
        mesh = trimesh.Trimesh(*simplified(np.asarray(whole.vertices), np.asarray(whole.faces), most_faces))
    else:
        whole = create_primitive_mesh(model, geom)
        mesh = trimesh.Trimesh(whole.vertices, whole.faces)
    pose = trimesh.transformations.quaternion_matrix(model.geom_quat[geom])
    pose[:3, 3] = model.geom_pos[geom]
    mesh.apply_transform(pose)
    return trimesh.graph.smooth_shade(mesh, angle=_SMOOTH_RAD, facet_minarea=None)


def _material(
    model: Any, look: tuple[int, tuple[float, ...]], tint: palette.Rgb | None, mix: float, opacity: float
) -> PBRMaterial:
    number, rgb = look[0], np.array(look[1], dtype=np.float32)
    if tint is not None:
        rgb = (1.0 - mix) * rgb + mix * np.array(tint) / 255.0
    metallic, roughness = _METALLIC, _ROUGHNESS
    if number >= 0:
        metallic, roughness = float(model.mat_metallic[number]), float(model.mat_roughness[number])
    return PBRMaterial(
        baseColorFactor=[*linear(rgb).tolist(), opacity],
        alphaMode="OPAQUE" if opacity >= 1.0 else "BLEND",
        metallicFactor=metallic if metallic >= 0.0 else _METALLIC,
        roughnessFactor=roughness if roughness >= 0.0 else _ROUGHNESS,
    )
