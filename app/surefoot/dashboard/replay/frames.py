"""From the rows of a saved run to what the page draws of them."""

import numpy as np

from surefoot.dashboard.messages.believed import BelievedRobot, soles_of
from surefoot.dashboard.messages.footprint import Footprint, footprints_of
from surefoot.dashboard.messages.snapshot import LOADED_N, Geometry
from surefoot.dashboard.messages.stone_view import stone_views
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.experiments.runs.saved_walk import SavedWalk
from surefoot.experiments.runs.saved_world import SavedWorld
from surefoot.experiments.scenario.robots import robot_named
from surefoot.geometry.polygon import convex_hull
from surefoot.geometry.rotations import quaternion_xyzw, rotation_from_vector, rotation_from_xyzw
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.simulation.conventions import qpos_from_q

_ERRORS = (("orientation_error", "rad"), ("position_error", "m"), ("believed_com", "m"))  # with an estimator only
_TRAIL_S, _TRAIL_ROWS = 1.2, 40


class ReplayFrames:
    """A saved run, row by row.

    Args:
        run: what was kept.

    Attributes:
        world: what was around the robot.

    Raises:
        InvalidInput: columns are missing, or the manifest makes no sense.
    """

    def __init__(self, run: SavedRun) -> None:
        try:
            self.robot: RobotDescription = robot_named(run.manifest["robot"])
            self.stance = {"left": (0,), "right": (1,), "double": (0, 1)}[run.manifest["support"]]
        except (KeyError, TypeError, ValueError, SurefootError) as error:
            raise InvalidInput("manifest", str(error), "is not that of a saved run") from None
        self.world, self._walk = SavedWorld(run), SavedWalk(run.manifest)
        self.run, self._dynamics = run, DynamicsModel(self.robot)
        self._loaded_n = LOADED_N * self.robot.sizes.weight
        joints = [f"angle_{joint.name}_rad" for joint in self.robot.joints]
        pelvis = [*(f"pelvis_{a}_m" for a in "xyz"), *(f"pelvis_q{a}" for a in "xyzw")]
        self.q = np.column_stack([run.column(name) for name in (*pelvis, *joints)])
        self.time_s = run.column("time_s")
        self._com = self._columns("com_x_m", "com_y_m", "com_z_m")
        self._zmp = self._columns("zmp_x_m", "zmp_y_m")
        self._commanded = self._columns("zmp_commanded_x_m", "zmp_commanded_y_m")
        self._capture = self._columns("capture_x_m", "capture_y_m")
        self._force = self._columns("force_left_n", "force_right_n")
        errors = [f"{what}_{a}_{unit}" for what, unit in _ERRORS for a in "xyz"]
        self._errors = self._columns(*errors) if set(errors) <= set(run.columns) else None

    def __len__(self) -> int:
        """Rows."""
        return len(self.time_s)

    def row_at(self, time_s: float) -> int:
        """The last row not after a time [s]."""
        return int(np.clip(np.searchsorted(self.time_s, time_s + 5e-7) - 1, 0, len(self) - 1))

    def geometry(self, row: int) -> Geometry:
        """Where everything was."""
        time_s = float(self.time_s[row])
        feet = self._dynamics.evaluate(RobotState(self.q[row], np.zeros(self.q.shape[1] - 1), time_s)).feet
        soles = soles_of(self.robot, feet)
        below = [
            foot.point_below(pose.position_ankle_in_world, pose.rotation_foot_to_world)
            for pose, foot in zip(feet, self.robot.feet, strict=True)
        ]
        ground = self.world.at_row(row)
        standing = tuple(np.flatnonzero(self._force[row] > self._loaded_n).tolist())
        return Geometry(
            qpos=qpos_from_q(self.q[row]),
            com=self._com[row],
            support_origin=np.mean([below[i] for i in self.stance], axis=0),
            zmp_measured=self._zmp[row],
            zmp_commanded=self._commanded[row],
            capture=self._capture[row],
            soles=soles,
            standing=standing,
            footprints=self._footprints(time_s, below, standing),
            support_polygon=self._support(row, soles),
            contacts=np.empty((0, 6)),
            stones=stone_views(self.world.stones(row), time_s, ground),
            trail=self._trail(row),
            ground_pivot=ground.pivot,
            ground_rotation=ground.rotation,
            believed=self._believed(row),
        )

    def _believed(self, row: int) -> BelievedRobot | None:
        """The robot as an estimator had it, from its errors in the record; joints are not in there: the true ones."""
        if self._errors is None:
            return None
        turned, moved, com = np.split(self._errors[row], (3, 6))
        q = self.q[row].copy()
        q[:3] += moved
        q[3:7] = quaternion_xyzw(rotation_from_vector(-turned).dot(rotation_from_xyzw(q[3:7])))
        feet = self._dynamics.evaluate(RobotState(q, np.zeros(len(q) - 1), float(self.time_s[row]))).feet
        return BelievedRobot(qpos=qpos_from_q(q), com=com, capture=np.full(2, np.nan), soles=soles_of(self.robot, feet))

    def _footprints(self, time_s: float, below: list[np.ndarray], standing: tuple[int, ...]) -> tuple[Footprint, ...]:
        """The steps that were to come, as high as what stood."""
        steps = self._walk.steps_ahead(time_s)
        height = float(np.mean([below[i][2] for i in standing or (0, 1)])) if steps else 0.0
        return footprints_of(steps, self.robot.feet, height)

    def _columns(self, *names: str) -> np.ndarray:
        return np.column_stack([self.run.column(name) for name in names])

    def _support(self, row: int, soles: np.ndarray) -> np.ndarray:
        """Hull, seen from above, of the soles that carried load, each corner at its own height."""
        loaded = [sole for sole, force in zip(soles, self._force[row], strict=True) if force > self._loaded_n]
        if not loaded:
            return np.empty((0, 3))
        corners = np.vstack(loaded)
        hull = convex_hull(corners[:, :2].tolist()).vertices
        nearest = ((hull[:, None, :] - corners[None, :, :2]) ** 2).sum(axis=2).argmin(axis=1)
        return corners[nearest]

    def _trail(self, row: int) -> np.ndarray:
        first = self.row_at(float(self.time_s[row]) - _TRAIL_S)
        rows = np.unique(np.linspace(first, row, _TRAIL_ROWS).astype(int))
        return np.column_stack((self._zmp[rows], self._com[rows, :2], self._capture[rows]))
