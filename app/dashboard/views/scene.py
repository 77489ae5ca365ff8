"""Bip, the ground and the stones: MuJoCo's shapes in the browser, placed from snapshots."""

from collections.abc import Callable, Mapping

import mujoco
import numpy as np
import viser
from mjviser import ViserMujocoScene
from mjviser.conversions import merge_geoms

from app.dashboard.commands import Command
from app.dashboard.snapshot import Geometry
from app.dashboard.views.ghost import Ghost
from app.dashboard.views.grip import LinkBox
from app.dashboard.views.stones import StonesView
from app.geometry.rotations import quaternion_wxyz
from app.robot.description import RobotDescription

CAMERA_POSITION = (2.25, 1.85, 1.55)
CAMERA_LOOK_AT = (0.0, 0.06, 0.8)
CAMERA_FOV_RAD = 0.75
_GROUND_LIFT_M = -0.0015


SEE_THROUGH = (FEET, ROBOT, NOTHING) = ("feet", "whole robot", "nothing")


class SceneView:
    """Robot, ground and stones.

    Args:
        server: where to draw.
        robot: whose shapes to draw; a model of the view's own, without a world.
        send: takes what a person does with the stones; None: nothing.
    """

    def __init__(
        self, server: viser.ViserServer, robot: RobotDescription, send: Callable[[Command], None] | None = None
    ) -> None:
        self._model = mujoco.MjModel.from_xml_path(str(robot.mjcf_path))
        self._data, self._other = mujoco.MjData(self._model), mujoco.MjData(self._model)
        self._robot = ViserMujocoScene(server, self._model, num_envs=1)
        self._robot.camera_tracking_enabled = False  # else the world moves under the overlays
        links = _links(self._model)
        self._opacity = self._model.geom_rgba[:, 3].copy()
        self._links, self._feet = set(links), {self._model.body(foot.body).id for foot in robot.feet}
        self._meshes = {body: _mesh(self._model, geoms) for body, geoms in links.items()}
        self._ghost = Ghost(server, self._meshes)
        self.see_through(FEET)
        self._ground = server.scene.add_grid(
            "/ground", infinite_grid=True, cell_size=0.1, section_size=1.0, cell_color=(190, 196, 202),
            section_color=(140, 148, 156), plane_color=(232, 236, 239), plane_opacity=1.0, fade_distance=14.0,
            shadow_opacity=0.35, position=(0.0, 0.0, _GROUND_LIFT_M),
        )  # fmt: skip
        self._stones = StonesView(server, "/stones", send)
        self._ground_rotation = np.eye(3)
        camera = server.initial_camera
        camera.position, camera.look_at, camera.fov = CAMERA_POSITION, CAMERA_LOOK_AT, CAMERA_FOV_RAD

    def see_through(self, part: str) -> None:
        """Make the feet, the whole robot or nothing see-through: one of ``SEE_THROUGH``."""
        bodies = {FEET: self._feet, ROBOT: self._links}.get(part, set())
        hidden = np.isin(self._model.geom_bodyid, list(bodies))
        self._model.geom_rgba[:, 3] = np.where(hidden, 0.0, self._opacity)  # mjviser leaves out what is invisible
        self._robot.rebuild_visual_handles()
        self._ghost.show(bodies)

    def set_dark(self, dark: bool) -> None:
        """Colours of the ground for a dark or a light page."""
        self._ground.plane_color = (52, 58, 64) if dark else (232, 236, 239)
        self._ground.cell_color = (84, 92, 100) if dark else (190, 196, 202)
        self._ground.section_color = (128, 136, 144) if dark else (140, 148, 156)

    def update(self, geometry: Geometry) -> None:
        """Move everything to where it is."""
        self._stones.draw(geometry.stones)
        self._lay_ground(geometry)
        if np.isfinite(geometry.qpos.sum()):
            self._data.qpos[:] = geometry.qpos
            mujoco.mj_kinematics(self._model, self._data)
            self._ghost.update(self._data.xpos, self._data.xquat)
            self._robot.update_from_mjdata(self._data)

    def link_meshes(self) -> Mapping[int, tuple[np.ndarray, np.ndarray]]:
        """Body number -> vertices and faces in the body's axes, to draw another robot of the same kind."""
        return self._meshes

    def link_poses(self, qpos: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Positions (n, 3) and quaternions (n, 4), w first, of all bodies of another robot of the same kind."""
        self._other.qpos[:] = qpos
        mujoco.mj_kinematics(self._model, self._other)
        return self._other.xpos, self._other.xquat

    def link_boxes(self) -> tuple[LinkBox, ...]:
        """The box around each link's shapes."""
        boxes = []
        for body, geoms in _links(self._model).items():
            vertices, _ = _mesh(self._model, geoms)
            low, high = vertices.min(axis=0), vertices.max(axis=0)
            boxes.append(LinkBox(self._model.body(body).name, body, 0.5 * (low + high), high - low))
        return tuple(boxes)

    def drawn_poses(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Positions (n, 3), quaternions (n, 4), w first, and rotations (n, 9) of all bodies, as drawn."""
        return self._data.xpos, self._data.xquat, self._data.xmat

    def _lay_ground(self, geometry: Geometry) -> None:
        pivot, rotation = geometry.ground_pivot, geometry.ground_rotation
        if not np.array_equal(rotation, self._ground_rotation):
            self._ground_rotation = rotation
            self._ground.wxyz = quaternion_wxyz(rotation)
            # the grid's own origin, carried along: it turns about the pivot
            self._ground.position = pivot - rotation.dot(pivot) + rotation[:, 2] * _GROUND_LIFT_M


def _links(model: mujoco.MjModel) -> dict[int, list[int]]:
    """Body -> its visible geoms."""
    found: dict[int, list[int]] = {}
    for geom in np.flatnonzero(model.geom_group < 3):
        found.setdefault(int(model.geom_bodyid[geom]), []).append(int(geom))
    return found


def _mesh(model: mujoco.MjModel, geoms: list[int]) -> tuple[np.ndarray, np.ndarray]:
    mesh = merge_geoms(model, geoms)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)
