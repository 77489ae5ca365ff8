"""What the controller believes of the robot, held against the truth."""

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.estimation.interface import ORIENTATION, POSITION, VELOCITY, Estimate
from surefoot.geometry.rotations import rotation_vector, skew
from surefoot.record import record


@record
class Belief:
    """One tick of an estimator, and how wrong it was.

    Attributes:
        terms: dynamics of the nominal robot at the believed state.
        position_com: believed CoM (3,) in world [m].
        capture: believed DCM (2,) in world [m].
        dcm_error: (2,) [m] in world: believed less true DCM, each as seen from the feet that carry. What an estimator
            does not know, where in the world it stands, is not in it: no balance depends on that. With errors of the
            model the true feet are those of the nominal legs at the true joint angles.
        dcm_sigma: (2,) standard deviation of the believed DCM in the world by the estimator's covariance [m], drift
            of the place included: more than that of dcm_error, ever more in a walk.
        orientation_error: (3,) rotation vector [rad] in world from the believed to the true base; the first two are
            tilt, the third is yaw, which nothing observes.
        orientation_sigma: (3,) likewise [rad].
        position_error: (3,) believed less true position of the base in world [m]: its drift.
    """

    terms: DynamicsTerms
    position_com: np.ndarray
    capture: np.ndarray
    dcm_error: np.ndarray
    dcm_sigma: np.ndarray
    orientation_error: np.ndarray
    orientation_sigma: np.ndarray
    position_error: np.ndarray


def measure_belief(
    estimate: Estimate,
    believed: DynamicsTerms,
    true: DynamicsTerms,
    com: tuple[np.ndarray, np.ndarray],
    omega: float,
) -> Belief:
    """Compare a belief with the truth.

    The variance of the DCM is that of d = p + c + v / omega with the errors of orientation, velocity and position; c is
    the arm from base to CoM, which a turn by theta moves by theta x c, and its rate likewise.

    Args:
        estimate: what is believed.
        believed: dynamics of the nominal robot at the believed state.
        true: the same at the true state.
        com: the plant's own centre of mass (3,) [m] and its velocity (3,) [m/s] in world.
        omega: natural frequency [rad/s].
    """
    position, velocity = believed.position_com_in_world, believed.velocity_com_in_world
    loads = np.maximum(estimate.sensing.normal_forces, 0.0)
    share = loads / loads.sum() if loads.sum() > 0.0 else np.array((0.5, 0.5))
    dcm_error = np.zeros(2)
    for sign, terms, (c, v) in ((1.0, believed, (position, velocity)), (-1.0, true, com)):
        stand = sum(part * foot.position_ankle_in_world for part, foot in zip(share, terms.feet, strict=True))
        dcm_error += sign * (c + v / omega - stand)[:2]
    rotation = believed.rotation_pelvis_to_world
    base_velocity = rotation.dot(believed.state.v[:3])
    arm, rate = position - believed.state.q[:3], velocity - base_velocity
    jacobian = np.empty((3, 9))
    jacobian[:, ORIENTATION] = -skew(arm + rate / omega)
    jacobian[:, VELOCITY], jacobian[:, POSITION] = np.eye(3) / omega, np.eye(3)
    variance = np.einsum("ij,jk,ik->i", jacobian, estimate.covariance, jacobian)
    return Belief(
        terms=believed,
        position_com=position,
        capture=(position + velocity / omega)[:2],
        dcm_error=dcm_error,
        dcm_sigma=np.sqrt(np.maximum(variance[:2], 0.0)),
        orientation_error=rotation_vector(true.rotation_pelvis_to_world.dot(rotation.T)),
        orientation_sigma=np.sqrt(np.maximum(np.diagonal(estimate.covariance)[ORIENTATION], 0.0)),
        position_error=believed.state.q[:3] - true.state.q[:3],
    )
