"""What a robot's sensors say, and what is known of the sensors themselves."""

import numpy as np

from surefoot.record import record


@record
class FootSensing:
    """What six-axis load cells between ankle and sole would say.

    Attributes:
        wrenches: (2, 6) left and right: force [N] and moment about the ankle centre [N m] of the ground on the foot,
            foot axes.
    """

    wrenches: np.ndarray

    @property
    def normal_forces(self) -> tuple[float, float]:
        """Force along each sole's normal [N]."""
        return float(self.wrenches[0, 2]), float(self.wrenches[1, 2])


@record
class ImuMount:
    """Where the inertial measurement unit sits.

    Attributes:
        body: link that carries it.
        position_in_body: (3,) its centre in the link's frame [m].
        rotation_in_body: (3, 3) IMU axes to link axes.
    """

    body: str
    position_in_body: np.ndarray
    rotation_in_body: np.ndarray


@record
class SensorReadings:
    """All that a robot gets to know in one tick.

    Attributes:
        time_s: instant at which the controller gets them [s]; what they tell of may be older.
        gyro: (3,) angular velocity of the IMU, IMU axes [rad/s].
        accelerometer: (3,) specific force at the IMU, IMU axes [m/s2]: its acceleration minus that of gravity, so
            9.81 upward at rest.
        joint_positions: (n,) encoders [rad].
        joint_velocities: (n,) as made from the encoders [rad/s].
        feet: force and moment of the ground on each foot about its ankle, foot axes.
    """

    time_s: float
    gyro: np.ndarray
    accelerometer: np.ndarray
    joint_positions: np.ndarray
    joint_velocities: np.ndarray
    feet: FootSensing


@record(kw_only=True)
class SensorNoise:
    """What the data sheets of the sensors say: what an estimator may be tuned by, never an actual error.

    Attributes:
        gyro: standard deviation of a sample [rad/s].
        gyro_bias: of the constant error of each axis [rad/s].
        accelerometer, accelerometer_bias: likewise [m/s2].
        joint_position, joint_velocity: of a sample [rad], [rad/s].
        foot_force, foot_force_bias: of a sample, and of the constant error [N].
        foot_moment, foot_moment_bias: likewise [N m].
    """

    gyro: float
    gyro_bias: float
    accelerometer: float
    accelerometer_bias: float
    joint_position: float
    joint_velocity: float
    foot_force: float
    foot_force_bias: float
    foot_moment: float
    foot_moment_bias: float


# Both feet loaded well beyond a twentieth of the weight: for computing with a posture that nothing has sensed
FULLY_LOADED = FootSensing(np.full((2, 6), 1e3))
