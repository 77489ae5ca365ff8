"""From the wanted kappa'' to q'': what all controllers do first."""

import numpy as np
from scipy.linalg.lapack import dgesv, dgetri, dgetrs  # pyright: ignore[reportAttributeAccessIssue]  (made at import)

from surefoot.control.balance.support import SupportGeometry
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import FOOT_ROWS, KAPPA_DIMENSION, DynamicsTerms
from surefoot.record import record
from surefoot.task.reference import TaskReference, tracking_acceleration


class GainTable:
    """The gains of a settings object, spread once over the rows of kappa."""

    def __init__(self, settings: ControllerSettings):
        self.stiffness, self.damping, self.weights = settings.stiffness(), settings.damping(), settings.weights()
        self.stance_foot_damping = settings.stance_foot_damping
        self.feedforward = settings.feedforward == "acceleration"


def commanded_output_acceleration(
    terms: DynamicsTerms, reference: TaskReference, gains: GainTable, support: SupportGeometry
) -> np.ndarray:
    """kappa'' (21,) of the tracking law (23), with the stance feet's rows replaced by those of contact.

    A stance foot is asked for -20 1/s times its velocity and for no pose: on bad ground it must follow the ground. In
    double support a foot that loses its load goes back to tracking smoothly.
    """
    command = tracking_acceleration(terms, reference, gains.stiffness, gains.damping)
    if not gains.feedforward:
        command[:2] -= reference.acceleration[:2]
    if reference.com_acceleration is not None:
        command[:3] = reference.com_acceleration
    for i in support.stance:
        rows, load = FOOT_ROWS[i], support.loads[i]
        contact = -gains.stance_foot_damping * terms.feet[i].velocity
        command[rows] = contact if load == 1.0 else load * contact + (1.0 - load) * command[rows]
    return command


@record
class AccelerationResponse:
    """q'' for a commanded kappa'', and how it answers a change of the CoM's horizontal acceleration.

    Attributes:
        acceleration: q'' (21,).
        per_com_acceleration: (21, 2) dq'' / d(kappa''_x, kappa''_y).
        factors: LU factors of H with their pivots.
    """

    acceleration: np.ndarray
    per_com_acceleration: np.ndarray
    factors: tuple[np.ndarray, np.ndarray]

    def inverse_output_jacobian(self) -> np.ndarray:
        """H^-1 (21, 21)."""
        return dgetri(*self.factors)[0]

    def solve(self, right: np.ndarray) -> np.ndarray:
        """H^-1 right (21,)."""
        return dgetrs(*self.factors, right)[0]

    def solve_transposed(self, right: np.ndarray) -> np.ndarray:
        """H^-T right (21, n); ``right`` is overwritten where its memory is laid out by columns."""
        return dgetrs(*self.factors, right, trans=1, overwrite_b=1)[0]

    def with_acceleration(self, acceleration: np.ndarray) -> "AccelerationResponse":
        """The same H with another q'' (21,)."""
        return AccelerationResponse(acceleration, self.per_com_acceleration, self.factors)


_RIGHT_HAND_SIDE = np.zeros((KAPPA_DIMENSION, 3), order="F")
_RIGHT_HAND_SIDE[0, 1] = _RIGHT_HAND_SIDE[1, 2] = 1.0


def acceleration_response(terms: DynamicsTerms, command: np.ndarray) -> AccelerationResponse:
    """Solve H q'' = kappa'' - h for the command and for two unit CoM accelerations at once.

    Equation: (20), (24)

    Args:
        terms: dynamics at the state.
        command: kappa'' (21,).
    """
    rhs = _RIGHT_HAND_SIDE.copy()
    rhs[:, 0] = command - terms.output_drift
    lu, pivots, solution, _ = dgesv(terms.output_jacobian, rhs, overwrite_b=1)
    return AccelerationResponse(solution[:, 0], solution[:, 1:], (lu, pivots))
