"""What the controller believes of the robot, held against the truth."""

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.estimation.interface import ORIENTATION, VELOCITY, Estimate
from surefoot.geometry.rotations import rotation_from_xyzw, rotation_vector, skew
from surefoot.record import record
from surefoot.robot.description import RobotState
from surefoot.simulation.plant import FootTruth


@record
class Belief:
    """One tick of an estimator, and how wrong it was.

    Attributes:
        terms: dynamics of the nominal robot at the believed state.
        position_com: believed CoM (3,) in world [m].
        capture: believed DCM (2,) in world [m].
        dcm_error: (2,) [m] in world: believed less true DCM, each as seen from the feet that carry. What an estimator
            does not know, where in the world it stands, is not in it: no balance depends on that.
        dcm_sigma: (2,) standard deviation of dcm_error [m] by the estimator's covariance, which is that of the base's
            orientation and velocity: joint angles and the model count as known.
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
    true: RobotState,
    feet: tuple[FootTruth, FootTruth],
    com: tuple[np.ndarray, np.ndarray],
    omega: float,
) -> Belief:
    """Compare a belief with the truth.

    Where the base is cancels out of d = c - s + (v + c') / omega, with c the CoM and s the feet that carry, both from
    the base in world axes, and v the velocity of the base. An error of orientation by theta changes it by
    theta x (c - s + c' / omega), one of velocity e by e / omega.

    Args:
        estimate: what is believed.
        believed: dynamics of the nominal robot at the believed state.
        true: the true state.
        feet: the plant's own feet in it.
        com: the plant's own centre of mass (3,) [m] and its velocity (3,) [m/s] in world.
        omega: natural frequency [rad/s].
    """
    position, velocity = believed.position_com_in_world, believed.velocity_com_in_world
    loads = np.maximum(estimate.sensing.normal_forces, 0.0)
    share = loads / loads.sum() if loads.sum() > 0.0 else np.array((0.5, 0.5))
    believed_stand = share.dot([foot.position_ankle_in_world for foot in believed.feet])
    true_stand = share.dot([foot.position_ankle for foot in feet])
    dcm_error = (position + velocity / omega - believed_stand) - (com[0] + com[1] / omega - true_stand)
    rotation, q = believed.rotation_pelvis_to_world, believed.state.q
    rate = velocity - rotation.dot(believed.state.v[:3])
    jacobian = np.zeros((3, 9))
    jacobian[:, ORIENTATION] = -skew(position - believed_stand + rate / omega)
    jacobian[:, VELOCITY] = np.eye(3) / omega
    variance = np.einsum("ij,jk,ik->i", jacobian, estimate.covariance, jacobian)
    return Belief(
        terms=believed,
        position_com=position,
        capture=(position + velocity / omega)[:2],
        dcm_error=dcm_error[:2],
        dcm_sigma=np.sqrt(np.maximum(variance[:2], 0.0)),
        orientation_error=rotation_vector(rotation_from_xyzw(true.q[3:7]).dot(rotation.T)),
        orientation_sigma=np.sqrt(np.maximum(np.diagonal(estimate.covariance)[ORIENTATION], 0.0)),
        position_error=q[:3] - true.q[:3],
    )
