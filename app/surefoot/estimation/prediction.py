"""A belief carried forward over the latency of the sensors that it was made of."""

from surefoot.geometry.rotations import quaternion_xyzw, rotation_from_xyzw, turn_by
from surefoot.robot.description import BASE_DOFS, RobotState


class Prediction:
    """Says where the robot is by now, where readings tell of a moment ago: it has gone on as fast as it was then.

    The base is taken for as old as the IMU's samples are, the joints for as old as the encoders'. How velocities have
    changed since is not told: of a joint it would be the derivative of noise.

    Args:
        base_s: age of what is believed of the base [s].
        joints_s: and of the joints [s].
    """

    def __init__(self, base_s: float, joints_s: float):
        self._base_s, self._joints_s = base_s, joints_s

    def ahead(self, state: RobotState) -> RobotState:
        """The state that much later; its time is unchanged: an estimate is for the instant that it is given at."""
        q, v = state.q.copy(), state.v.copy()
        R, turn = rotation_from_xyzw(q[3:7]), turn_by(v[3:BASE_DOFS] * self._base_s)
        q[:3] += R.dot(v[:3]) * self._base_s
        q[3:7] = quaternion_xyzw(R.dot(turn))
        v[:3] = v[:3].dot(turn)  # the same velocity in world, in axes that have turned
        q[7:] += v[BASE_DOFS:] * self._joints_s
        return RobotState(q, v, state.time_s)
