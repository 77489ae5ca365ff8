"""The frozen bundle that one evaluation of the dynamics returns, and the layout of kappa in it."""

from dataclasses import fields

import numpy as np

from surefoot.record import record
from surefoot.robot.description import RobotState

# Rows of kappa (2). The paper fixes only "CoM first, feet at 13..18" (1-based); this is our completion. The joints that
# are in no leg come last, so that with two legs of six joints kappa has as many rows as q'' whatever the robot.
COM = slice(0, 3)
PELVIS = slice(3, 6)
LEFT_FOOT = slice(6, 12)
RIGHT_FOOT = slice(12, 18)
UPPER = slice(18, None)
FOOT_ROWS = (LEFT_FOOT, RIGHT_FOOT)


@record(kw_only=True)
class FootTerms:
    """One foot at one state; world axes, at the ankle centre.

    Attributes:
        position_ankle_in_world: (3,) [m].
        rotation_foot_to_world: (3, 3).
        jacobian: (6, n) velocity -> linear [m/s] and angular [rad/s] velocity of the foot.
        velocity: (6,) that velocity now.
        drift: (6,) its rate of change when all velocity derivatives are zero.
    """

    position_ankle_in_world: np.ndarray
    rotation_foot_to_world: np.ndarray
    jacobian: np.ndarray
    velocity: np.ndarray
    drift: np.ndarray


@record(kw_only=True)
class DynamicsTerms:
    """Everything a tick needs to know of the dynamics, evaluated once, of a robot with n degrees of freedom.

    Attributes:
        state: the state they belong to.
        mass_kg, gravity: m [kg] and g [m/s2].
        mass_matrix: M (n, n), rotor inertia included.
        bias: N q' + G (n,), with what the springs in joints take [N, N m].
        position_com_in_world, velocity_com_in_world: G (3,) [m], G' (3,) [m/s].
        centroidal_map: (6, n) velocity -> linear [kg m/s] and angular [kg m2/s] momentum about G, world axes.
        centroidal_drift: (6,) rate of that momentum [N, N m] when all velocity derivatives are zero.
        rotation_pelvis_to_world: (3, 3) of the base (Bip: the pelvis).
        upper_rad: (n - 18,) angles of the joints that are in no leg (Bip: the lumbar joints).
        feet: left, right.
        output_jacobian: H (n, n) of kappa.
        output_velocity: H v (n,).
        output_drift: h = H' v (n,).
    """

    state: RobotState
    mass_kg: float
    gravity: float
    mass_matrix: np.ndarray
    bias: np.ndarray
    position_com_in_world: np.ndarray
    velocity_com_in_world: np.ndarray
    centroidal_map: np.ndarray
    centroidal_drift: np.ndarray
    rotation_pelvis_to_world: np.ndarray
    upper_rad: np.ndarray
    feet: tuple[FootTerms, FootTerms]
    output_jacobian: np.ndarray
    output_velocity: np.ndarray
    output_drift: np.ndarray

    def is_finite(self) -> bool:
        """Whether every number is finite."""
        values = [getattr(part, item.name) for part in (self, *self.feet) for item in fields(part)]
        return all(np.isfinite(value).all() for value in values if isinstance(value, np.ndarray))
