"""A robot that sways on one foot and then on the other, with the readings of perfect sensors: by Pinocchio alone.

The joints follow given smooth curves; the foot that stands does not move, and from that follow the base's pose,
velocity and acceleration. Between two feet everything is at rest for an instant, so that nothing jumps.
"""

from dataclasses import dataclass

import numpy as np

from surefoot.dynamics.model import foot_frame_name, with_foot_frames
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.pinocchio_library import pin
from surefoot.robot.sensing import FootSensing, ImuMount, SensorReadings

AXES = pin.LOCAL_WORLD_ALIGNED


@dataclass(frozen=True, eq=False)
class Instant:
    """The truth at one instant, and what perfect sensors read."""

    state: RobotState
    readings: SensorReadings


class SwayingRobot:
    """Stands on its left foot, then on its right one, and so on, for one period each.

    Args:
        robot: the robot.
        mount: of the IMU.
        period_s: how long it stands on one foot.
        amplitude_rad: of the joints.
        seed: of the joints' directions.
        first: orientation (3, 3) of the first stance foot in the world.
    """

    def __init__(
        self,
        robot: RobotDescription,
        mount: ImuMount,
        *,
        period_s: float = 1.0,
        amplitude_rad: float = 0.15,
        seed: int = 0,
        first: np.ndarray | None = None,
    ):
        self.robot, self._period_s = robot, period_s
        self._model = with_foot_frames(robot).copy()
        link = self._model.frames[self._model.getFrameId(mount.body)]
        placement = link.placement * pin.SE3(mount.rotation_in_body, mount.position_in_body)
        imu = pin.Frame("imu", link.parentJoint, self._model.getFrameId(mount.body), placement, pin.FrameType.OP_FRAME)
        self._imu = self._model.addFrame(imu)
        self._feet = [self._model.getFrameId(foot_frame_name(foot)) for foot in robot.feet]
        self._data = self._model.createData()
        self._rng = np.random.default_rng(seed)
        self._amplitudes = [self._rng.uniform(-amplitude_rad, amplitude_rad, len(robot.joints)) for _ in range(64)]
        self._stands = [pin.SE3(np.eye(3) if first is None else first, np.array((0.3, -0.2, 0.1)))]
        for turn in range(63):  # where the other foot is when its turn comes: all joints are back then
            q = np.concatenate((pin.neutral(self._model)[:7], robot.start_angles))
            here, other = (self._placement(q, self._feet[(turn + i) % 2]) for i in range(2))
            self._stands.append(self._stands[turn] * here.inverse() * other)

    def _placement(self, q: np.ndarray, frame: int) -> pin.SE3:
        pin.forwardKinematics(self._model, self._data, q)
        return pin.updateFramePlacement(self._model, self._data, frame).copy()

    def at(self, time_s: float) -> Instant:
        """Truth and readings."""
        model, data = self._model, self._data
        turn = int(time_s / self._period_s)
        share, rate = time_s / self._period_s - turn, 2.0 * np.pi / self._period_s
        # sin^3: no rate and no acceleration at either end
        sine, cosine = np.sin(share * 2.0 * np.pi), np.cos(share * 2.0 * np.pi)
        shape, shape1 = sine**3, 3.0 * sine**2 * cosine * rate
        shape2 = (6.0 * sine * cosine**2 - 3.0 * sine**3) * rate**2
        amplitude, joints = self._amplitudes[turn], len(self.robot.joints)
        frame = self._feet[turn % 2]
        q = np.concatenate((pin.neutral(model)[:7], self.robot.start_angles + shape * amplitude))
        base = self._stands[turn] * self._placement(q, frame).inverse()
        q[:7] = pin.SE3ToXYZQUAT(base)

        v, a = np.zeros(6 + joints), np.zeros(6 + joints)
        v[6:], a[6:] = shape1 * amplitude, shape2 * amplitude
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        J = pin.getFrameJacobian(model, data, frame, AXES)
        v[:6] = -np.linalg.solve(J[:, :6], J[:, 6:] @ v[6:])
        pin.forwardKinematics(model, data, q, v, np.zeros(6 + joints))
        drift = pin.getFrameClassicalAcceleration(model, data, frame, AXES).vector
        a[:6] = -np.linalg.solve(J[:, :6], J[:, 6:] @ a[6:] + drift)
        pin.forwardKinematics(model, data, q, v, a)
        pin.updateFramePlacements(model, data)
        into_imu = data.oMf[self._imu].rotation.T
        gyro = pin.getFrameVelocity(model, data, self._imu, pin.LOCAL).angular
        acceleration = pin.getFrameClassicalAcceleration(model, data, self._imu, AXES).linear
        wrenches = np.zeros((2, 6))
        wrenches[turn % 2, 2] = self.robot.mass_kg * self.robot.gravity
        readings = SensorReadings(
            time_s,
            gyro.copy(),
            into_imu @ (acceleration + np.array((0.0, 0.0, self.robot.gravity))),
            q[7:].copy(),
            v[6:].copy(),
            FootSensing(wrenches),
        )
        return Instant(RobotState(q.copy(), v.copy(), time_s), readings)
