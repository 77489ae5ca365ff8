"""The frozen bundle that one evaluation of the dynamics returns, and the layout of kappa in it."""

from dataclasses import fields

import numpy as np

from surefoot.record import record
from surefoot.robot.description import RobotState

# Rows of kappa (2). The paper fixes only "CoM first, feet at 13..18" (1-based); this is our completion.
COM = slice(0, 3)
PELVIS = slice(3, 6)
LEFT_FOOT = slice(6, 12)
RIGHT_FOOT = slice(12, 18)
LUMBAR = slice(18, 21)
FOOT_ROWS = (LEFT_FOOT, RIGHT_FOOT)
KAPPA_DIMENSION = 21


@record(kw_only=True)
class FootTerms:
    """One foot at one state; world axes, at the ankle centre.

    Attributes:
        position_ankle_in_world: (3,) [m].
        rotation_foot_to_world: (3, 3).
        jacobian: (6, 21) velocity -> linear [m/s] and angular [rad/s] velocity of the foot.
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
    """Everything a tick needs to know of the dynamics, evaluated once.

    Attributes:
        state: the state they belong to.
        mass_kg, gravity: m [kg] and g [m/s2].
        mass_matrix: M (21, 21), rotor inertia included.
        bias: N q' + G (21,) [N, N m].
        position_com_in_world, velocity_com_in_world: G (3,) [m], G' (3,) [m/s].
        centroidal_map: (6, 21) velocity -> linear [kg m/s] and angular [kg m2/s] momentum about G, world axes.
        centroidal_drift: (6,) rate of that momentum [N, N m] when all velocity derivatives are zero.
        rotation_pelvis_to_world: (3, 3).
        lumbar_rad: (3,) lumbar joint angles.
        feet: left, right.
        output_jacobian: H (21, 21) of kappa.
        output_velocity: H v (21,).
        output_drift: h = H' v (21,).
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
    lumbar_rad: np.ndarray
    feet: tuple[FootTerms, FootTerms]
    output_jacobian: np.ndarray
    output_velocity: np.ndarray
    output_drift: np.ndarray

    def is_finite(self) -> bool:
        """Whether every number is finite."""
        values = [getattr(part, item.name) for part in (self, *self.feet) for item in fields(part)]
        return all(np.isfinite(value).all() for value in values if isinstance(value, np.ndarray))
