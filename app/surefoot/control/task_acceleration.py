"""From the wanted kappa'' to q'': what all controllers do first."""

from functools import lru_cache

import numpy as np
from scipy.linalg.lapack import dgesv, dgetri, dgetrs  # pyright: ignore[reportAttributeAccessIssue]  (made at import)

from surefoot.control.balance.support import SupportGeometry
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import FOOT_ROWS, DynamicsTerms
from surefoot.record import record
from surefoot.robot.description import RobotDescription
from surefoot.task.reference import TaskReference, tracking_acceleration


class GainTable:
    """The gains of a settings object, spread once over the rows of a robot's kappa."""

    def __init__(self, robot: RobotDescription, settings: ControllerSettings):
        rows = robot.dofs
        self.stiffness, self.damping = settings.stiffness(rows), settings.damping(rows)
        self.weights = settings.weights(rows)
        self.stance_foot_damping = settings.stance_foot_damping
        self.feedforward = settings.feedforward == "acceleration"


def commanded_output_acceleration(
    terms: DynamicsTerms, reference: TaskReference, gains: GainTable, support: SupportGeometry
) -> np.ndarray:
    """kappa'' (n,) of the tracking law (23), with the stance feet's rows replaced by those of contact.

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
        acceleration: q'' (n,).
        per_com_acceleration: (n, 2) dq'' / d(kappa''_x, kappa''_y).
        factors: LU factors of H with their pivots.
    """

    acceleration: np.ndarray
    per_com_acceleration: np.ndarray
    factors: tuple[np.ndarray, np.ndarray]

    def inverse_output_jacobian(self) -> np.ndarray:
        """H^-1 (n, n)."""
        return dgetri(*self.factors)[0]

    def solve(self, right: np.ndarray) -> np.ndarray:
        """H^-1 right (n,)."""
        return dgetrs(*self.factors, right)[0]

    def solve_transposed(self, right: np.ndarray) -> np.ndarray:
        """H^-T right (n, k); ``right`` is overwritten where its memory is laid out by columns."""
        return dgetrs(*self.factors, right, trans=1, overwrite_b=1)[0]

    def with_acceleration(self, acceleration: np.ndarray) -> "AccelerationResponse":
        """The same H with another q'' (n,)."""
        return AccelerationResponse(acceleration, self.per_com_acceleration, self.factors)


@lru_cache(maxsize=8)
def _right_hand_side(rows: int) -> np.ndarray:
    columns = np.zeros((rows, 3), order="F")
    columns[0, 1] = columns[1, 2] = 1.0
    return columns


def acceleration_response(terms: DynamicsTerms, command: np.ndarray) -> AccelerationResponse:
    """Solve H q'' = kappa'' - h for the command and for two unit CoM accelerations at once.

    Equation: (20), (24)

    Args:
        terms: dynamics at the state.
        command: kappa'' (n,).
    """
    rhs = _right_hand_side(len(command)).copy()
    rhs[:, 0] = command - terms.output_drift
    lu, pivots, solution, _ = dgesv(terms.output_jacobian, rhs, overwrite_b=1)
    return AccelerationResponse(solution[:, 0], solution[:, 1:], (lu, pivots))
