"""Bip, the ground and the stones: MuJoCo's shapes in the browser, placed from snapshots."""

import mujoco
import numpy as np
import viser
from mjviser import ViserMujocoScene
from mjviser.conversions import merge_geoms

from app.dashboard import palette
from app.dashboard.snapshot import Geometry
from app.dashboard.views.ghost import Ghost
from app.robot.description import RobotDescription

CAMERA_POSITION = (2.25, 1.85, 1.55)
CAMERA_LOOK_AT = (0.0, 0.06, 0.8)
CAMERA_FOV_RAD = 0.75
_MOST_STONES = 24
_UNSEEN = np.array((0.0, 0.0, -5.0))


SEE_THROUGH = (FEET, ROBOT, NOTHING) = ("feet", "whole robot", "nothing")


class SceneView:
    """Robot, ground and stones.

    Args:
        server: where to draw.
        robot: whose shapes to draw; a model of the view's own, without a world.
    """

    def __init__(self, server: viser.ViserServer, robot: RobotDescription) -> None:
        self._model = mujoco.MjModel.from_xml_path(str(robot.mjcf_path))
        self._data = mujoco.MjData(self._model)
        self._robot = ViserMujocoScene(server, self._model, num_envs=1)
        self._robot.camera_tracking_enabled = False  # else the world moves under the overlays
        links = _links(self._model)
        self._opacity = self._model.geom_rgba[:, 3].copy()
        self._links, self._feet = set(links), {self._model.body(foot.body).id for foot in robot.feet}
        self._ghost = Ghost(server, {body: _mesh(self._model, geoms) for body, geoms in links.items()})
        self.see_through(FEET)
        self._ground = server.scene.add_grid(
            "/ground", infinite_grid=True, cell_size=0.1, section_size=1.0, cell_color=(190, 196, 202),
            section_color=(140, 148, 156), plane_color=(232, 236, 239), plane_opacity=1.0, fade_distance=14.0,
            shadow_opacity=0.35, position=(0.0, 0.0, -0.0015),
        )  # fmt: skip
        corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
        self._stones = server.scene.add_batched_meshes_simple(
            "/stones", corners, _BOX_FACES,
            batched_wxyzs=np.tile((1.0, 0.0, 0.0, 0.0), (_MOST_STONES, 1)),
            batched_positions=np.tile(_UNSEEN, (_MOST_STONES, 1)),
            batched_scales=np.full((_MOST_STONES, 3), 0.01),
            batched_colors=palette.STONE, flat_shading=True, lod="off", side="double",
        )  # fmt: skip
        self._stones_drawn = np.empty((0, 6))
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
        self._draw_stones(geometry.stones)
        if np.isfinite(geometry.qpos.sum()):
            self._data.qpos[:] = geometry.qpos
            mujoco.mj_kinematics(self._model, self._data)
            self._ghost.update(self._data.xpos, self._data.xquat)
            self._robot.update_from_mjdata(self._data)

    def _draw_stones(self, stones: np.ndarray) -> None:
        if np.array_equal(stones, self._stones_drawn):
            return
        self._stones_drawn = stones
        positions = np.tile(_UNSEEN, (_MOST_STONES, 1))
        scales = np.full((_MOST_STONES, 3), 0.01)
        positions[: len(stones)], scales[: len(stones)] = stones[:, :3], stones[:, 3:]
        self._stones.batched_positions, self._stones.batched_scales = positions, scales


def _links(model: mujoco.MjModel) -> dict[int, list[int]]:
    """Body -> its visible geoms."""
    found: dict[int, list[int]] = {}
    for geom in np.flatnonzero(model.geom_group < 3):
        found.setdefault(int(model.geom_bodyid[geom]), []).append(int(geom))
    return found


def _mesh(model: mujoco.MjModel, geoms: list[int]) -> tuple[np.ndarray, np.ndarray]:
    mesh = merge_geoms(model, geoms)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


_BOX_FACES = np.array([
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
    (1, 5, 7), (1, 7, 3),
])  # fmt: skip
