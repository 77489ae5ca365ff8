"""The tracking law in task space: errors of kappa and the acceleration that makes them decay."""

import numpy as np

from surefoot.dynamics.terms import COM, KAPPA_DIMENSION, LUMBAR, PELVIS, DynamicsTerms
from surefoot.geometry.rotations import rotation_vector
from surefoot.task.reference import TaskReference


def task_error(terms: DynamicsTerms, reference: TaskReference) -> np.ndarray:
    """e = kappa(q) - kappa_d (21,); orientations as the world rotation vector from the wanted to the actual one.

    Equation: (18)
    """
    e = np.empty(KAPPA_DIMENSION)
    e[COM] = terms.position_com_in_world - reference.position_com
    e[PELVIS] = rotation_vector(terms.rotation_pelvis_to_world.dot(reference.rotation_pelvis_to_world.T))
    row = 6
    for foot, position, rotation in zip(
        terms.feet, reference.position_ankles, reference.rotation_feet_to_world, strict=True
    ):
        e[row : row + 3] = foot.position_ankle_in_world - position
        e[row + 3 : row + 6] = rotation_vector(foot.rotation_foot_to_world.dot(rotation.T))
        row += 6
    e[LUMBAR] = terms.lumbar_rad - reference.lumbar_rad
    return e


def tracking_acceleration(
    terms: DynamicsTerms, reference: TaskReference, stiffness: np.ndarray, damping: np.ndarray
) -> np.ndarray:
    """The commanded kappa'' = v + kappa_d'' with v = -K_P e - K_D e'.

    Applied exactly, the error obeys e'' + K_D e' + K_P e = 0 and decays; the paper's "e'' = 0 gives asymptotic
    stability" (21) is a slip for this. q'' follows from (20): q'' = H^-1 (kappa'' - h).

    Equation: (19)-(21), (23)-(25)

    Args:
        terms: dynamics at the state; e' = H v - kappa_d'.
        reference: the wanted kappa.
        stiffness: diagonal of K_P (21,) [1/s2].
        damping: diagonal of K_D (21,) [1/s].

    Returns:
        kappa'' (21,) [m/s2, rad/s2].
    """
    error = task_error(terms, reference)
    error_rate = terms.output_velocity - reference.velocity
    return reference.acceleration - stiffness * error - damping * error_rate


def com_acceleration(terms: DynamicsTerms, acceleration: np.ndarray) -> np.ndarray:
    """a_G (3,) [m/s2] as the first three rows of kappa'' = H q'' + h: the mass-weighted mean of the links'.

    The paper prints (26) without the masses, and calls the third row kappa_2.

    Equation: (26), (27)
    """
    return terms.output_jacobian[COM].dot(acceleration) + terms.output_drift[COM]
