"""The robot in its world: sense, step, measure. The only owner of MjData."""

import math
from collections.abc import Sequence

import mujoco
import numpy as np

from surefoot.geometry.rotations import cross
from surefoot.record import record
from surefoot.robot.description import BASE_DOFS, RobotDescription, RobotState
from surefoot.robot.sensing import FootSensing
from surefoot.simulation.checkpoint import WorldMemory
from surefoot.simulation.conventions import qpos_from_q, state_from_mujoco
from surefoot.simulation.external_forces import NO_FORCE, WHOLE_ROBOT, ActingForce, Pull, Push, sum_of_forces
from surefoot.simulation.ground import Ground, GroundPose
from surefoot.simulation.imperfections import PERFECT_PLANT, Imperfections
from surefoot.simulation.model_error import as_built
from surefoot.simulation.motors import Motors, MotorSettings
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.sensors.probe import ImuProbe
from surefoot.simulation.sensors.signals import IdealSignals
from surefoot.simulation.stone_pool import StonePool
from surefoot.simulation.terrain import LEVEL, Terrain
from surefoot.simulation.true_com import TrueCom
from surefoot.simulation.world import IMU, apply_physics, build_world, turn_floor


@record
class FootTruth:
    """One foot as the simulator knows it; for metrics and views, never for a controller.

    Attributes:
        position_ankle: (3,) in world [m].
        rotation: (3, 3) foot to world.
        force: of everything that touches the foot (3,) in world [N].
        moment: of the same about the ankle (3,) in world [N m].
    """

    position_ankle: np.ndarray
    rotation: np.ndarray
    force: np.ndarray
    moment: np.ndarray


class Plant:
    """MuJoCo behind the four verbs the loop needs.

    Args:
        robot: what to simulate.
        physics: how it differs from the nominal model.
        ground: how the ground lies over time; flat by default.
        pivot: point of the ground (3,) in world [m] about which it slopes or tilts.
        terrain: what stands on it; nothing by default.
        imperfections: IMU, motors and errors of the model; none by default.

    Attributes:
        built: the robot with its soles where errors of the model have put them, for metrics and views.
        acting: sum of pushes and pulls in the last step.
    """

    def __init__(
        self,
        robot: RobotDescription,
        physics: PhysicsSettings,
        ground: Ground | None = None,
        pivot: np.ndarray | None = None,
        terrain: Terrain = LEVEL,
        imperfections: Imperfections = PERFECT_PLANT,
    ):
        self.robot, self.physics, self.terrain = robot, physics, terrain
        self.imperfections, self.built = imperfections, as_built(robot, imperfections.model_error)
        self.model = build_world(robot, physics, terrain, imperfections)
        self.data = mujoco.MjData(self.model)
        self.memory = WorldMemory(self.model, self.data)
        self.ground = GroundPose(ground or Ground(), np.zeros(3) if pivot is None else pivot)
        self.stones = StonePool(self.model, self.data, self.ground)
        self._base = self.model.body(robot.base).id
        self._feet = np.array([self.model.body(foot.body).id for foot in robot.feet])
        self._bodies = {link: self.model.body(link).id for link in robot.links}
        self._torque_limits = robot.torque_limits
        imu, motors = imperfections.imu, imperfections.motors
        self._imu = ImuProbe(self.model, imu, IMU) if imu is not None else None
        self._motors = Motors(motors, robot.torque_limits) if motors != MotorSettings() else None
        self.true_com: TrueCom | None = None  # made when it is first asked for
        self._feet_now: tuple[FootTruth, FootTruth] | None = None
        self.acting = NO_FORCE

    @property
    def time_s(self) -> float:
        """Simulated time [s]."""
        return float(self.data.time)

    @property
    def mass_kg(self) -> float:
        """Of the robot here [kg]; another than the nominal one's with errors of the model or ``mass_scale``."""
        if self.imperfections.model_error.any or self.physics.mass_scale != 1.0:
            return float(self.model.body_subtreemass[self._base])
        return self.robot.mass_kg

    def reset(self, q: np.ndarray, *, drop_height_m: float = 0.0) -> None:
        """Put the robot at rest in a configuration (7 + joints,), let down until the ground carries its weight.

        With a drop height it is released that far [m] above where the configuration has it instead, its feet unloaded.
        Stones are cleared.
        """
        mujoco.mj_resetData(self.model, self.data)
        self.memory.note_reset()
        self.stones.clear()
        if self._motors is not None:
            self._motors.reset()
        if not self._move_ground() and self.terrain.blocks:  # their body is level again
            turn_floor(self.model, self.data, self.ground, self.terrain)
        self.data.qpos[:] = qpos_from_q(q)
        height, weight = float(q[2]), float(self.model.body_subtreemass[self._base]) * self.robot.gravity
        up = self.ground.up
        error = self.imperfections.model_error  # the legs may be longer or shorter than the configuration's
        slack = error.length * height + error.sole_m
        shallow, deep = -slack, 0.005 + slack
        for _ in range(30):  # at rest and unaccelerated, how deep must the soles sink to carry the weight?
            depth = 0.5 * (shallow + deep)
            self.data.qpos[2] = height - depth
            self.data.qacc[:] = 0.0
            mujoco.mj_inverse(self.model, self.data)
            mujoco.mj_rnePostConstraint(self.model, self.data)
            carried = sum(float(foot.force.dot(up)) for foot in self._read_feet())
            shallow, deep = (depth, deep) if carried < weight * float(up[2]) else (shallow, depth)
        self._feet_now = self._read_feet()  # what load cells say of a robot that stands still
        if drop_height_m > 0.0:
            self.data.qpos[2], self._feet_now = height + drop_height_m, None
        mujoco.mj_forward(self.model, self.data)

    def sense(self) -> tuple[RobotState, FootSensing]:
        """State now, and the foot forces of the last step, as a robot could have them."""
        data = self.data
        rotation = _rotation_from_wxyz(data.qpos[3:7])
        state = state_from_mujoco(data.qpos, data.qvel, rotation, data.time)
        return state, self._sense_feet()

    def signals(self) -> IdealSignals:
        """What ideal sensors would say now; only of a plant with an IMU."""
        model, data, imu = self.model, self.data, self._imu
        if imu is None:
            raise ValueError("this plant was built without an IMU")
        stepped = self.memory.stepped
        force = imu.accelerometer(data) if stepped else imu.accelerometer_at_rest(model, data)
        gyro, angles, rates = imu.gyro(model, data), data.qpos[BASE_DOFS + 1 :], data.qvel[BASE_DOFS:]
        return IdealSignals(gyro, force, angles.copy(), rates.copy(), self._sense_feet())

    def _sense_feet(self) -> FootSensing:
        wrenches = np.empty((2, 6))
        for row, foot in zip(wrenches, self.feet(), strict=True):
            np.dot(foot.force, foot.rotation, out=row[:3])
            np.dot(foot.moment, foot.rotation, out=row[3:])
        return FootSensing(wrenches)

    def step(self, torques: np.ndarray, pushes: Sequence[Push] = (), pulls: Sequence[Pull] = ()) -> np.ndarray:
        """Apply torques (n,) [N m] for one millisecond; returns what the motors gave after saturation.

        Of a push, the force of this tick is applied: nothing before its start and after its end.
        """
        data = self.data
        self.stones.move(data.time, ground_moved=self._move_ground())
        applied = torques
        if self.physics.torque_limits:
            applied = np.minimum(np.maximum(torques, -self._torque_limits), self._torque_limits)
        if self._motors is not None:
            applied = self._motors.give(applied, data.qvel[BASE_DOFS:])
        data.ctrl[:] = applied
        self.acting = sum_of_forces([*self._apply_pushes(pushes), *(self._apply_pull(pull) for pull in pulls)])
        self.memory.note_step()
        mujoco.mj_step(self.model, data)
        self._feet_now = None
        return applied

    def feet(self) -> tuple[FootTruth, FootTruth]:
        """Both feet with the contact wrench of the last step, at the pose it acted on."""
        if self._feet_now is None:
            mujoco.mj_rnePostConstraint(self.model, self.data)
            self._feet_now = self._read_feet()
        return self._feet_now

    def is_finite(self) -> bool:
        """Whether the last step left numbers behind (the square of the length is finite only then)."""
        return math.isfinite(float(self.data.qpos.dot(self.data.qpos)) + float(self.data.qvel.dot(self.data.qvel)))

    def change_physics(self, physics: PhysicsSettings) -> None:
        """Change the plant while it runs."""
        friction_scale = self.imperfections.model_error.friction_scale
        apply_physics(self.model, physics, mass_scale_before=self.physics.mass_scale, friction_scale=friction_scale)
        self.physics = physics

    def link_rotation(self, link: str) -> np.ndarray:
        """Orientation of a link (3, 3), link to world, at the last step."""
        return self.data.xmat[self._bodies[link]].reshape(3, 3)

    def position_com(self) -> np.ndarray:
        """The plant's own centre of mass (3,) in world [m] at the last step."""
        return self.data.subtree_com[self._base].copy()

    def com_now(self) -> tuple[np.ndarray, np.ndarray]:
        """Position (3,) [m] and velocity (3,) [m/s] of the plant's own centre of mass in world, at the state now."""
        if self.true_com is None:
            self.true_com = TrueCom(self.model, self._base)
        return self.true_com.at(self.data.qpos, self.data.qvel)

    def _move_ground(self) -> bool:
        moved = self.ground.move(self.time_s)
        if moved:
            turn_floor(self.model, self.data, self.ground, self.terrain)
        return moved

    def _read_feet(self) -> tuple[FootTruth, FootTruth]:
        data = self.data
        centre = data.subtree_com[self._base]
        wrenches = data.cfrc_ext.take(self._feet, axis=0)  # moment about the subtree's CoM, then force; world
        positions, rotations = data.xpos.take(self._feet, axis=0), data.xmat.take(self._feet, axis=0)
        feet = []
        for i, foot in enumerate(self.robot.feet):
            force, position, rotation = wrenches[i, 3:], positions[i], rotations[i].reshape(3, 3)
            if not foot.is_body_frame:
                position, rotation = position + rotation.dot(foot.ankle_in_body), rotation.dot(foot.rotation_in_body)
            moment = wrenches[i, :3] + cross(centre - position, force)
            feet.append(FootTruth(position, rotation, force, moment))
        return feet[0], feet[1]

    def _apply_pushes(self, pushes: Sequence[Push]) -> list[ActingForce]:
        data, model = self.data, self.model
        data.qfrc_applied[:] = 0.0
        acting = []
        for push in pushes:
            force = push.force_at(data.time)
            if not force.any():
                continue
            if push.link == WHOLE_ROBOT:
                self._push_through_com(force)
                acting.append(ActingForce(force, self.position_com()))
            else:
                body = model.body(push.link).id
                mujoco.mj_applyFT(model, data, force, np.zeros(3), data.xipos[body], body, data.qfrc_applied)
                acting.append(ActingForce(force, data.xipos[body].copy()))
        return acting

    def held_point(self, pull: Pull) -> tuple[np.ndarray, np.ndarray]:
        """Where the point that a pull holds is (3,) in world [m], and its velocity (3,) [m/s]."""
        body = self.model.body(pull.link).id
        position = self.data.xpos[body] + self.data.xmat[body].reshape(3, 3).dot(pull.point)
        jacobian = np.empty((3, self.model.nv))
        mujoco.mj_jac(self.model, self.data, jacobian, None, position, body)
        return position, jacobian.dot(self.data.qvel)

    def _apply_pull(self, pull: Pull) -> ActingForce:
        position, velocity = self.held_point(pull)
        body, force = self.model.body(pull.link).id, pull.force(position, velocity)
        mujoco.mj_applyFT(self.model, self.data, force, np.zeros(3), position, body, self.data.qfrc_applied)
        return ActingForce(force, position)

    def _push_through_com(self, force: np.ndarray) -> None:
        """The generalized force J_com^T F: every link takes its mass's share, so nothing turns about G."""
        jacobian = np.empty((3, self.model.nv))
        mujoco.mj_jacSubtreeCom(self.model, self.data, jacobian, self._base)
        self.data.qfrc_applied += force.dot(jacobian)


def _rotation_from_wxyz(quaternion: np.ndarray) -> np.ndarray:
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)
