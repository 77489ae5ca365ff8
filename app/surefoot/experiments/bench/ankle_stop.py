"""How long an ankle that carries is at its stop: there it can follow the tilted sole, and shift the ZMP, no further."""

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.simulation.falls import PERSISTENCE_TICKS, RANGE_SLACK_RAD, SUPPORT_LOST_N
from surefoot.simulation.measurement import BalanceMeasurement
from surefoot.simulation.physics import TIMESTEP_S

BEFORE_S = 1.0  # before the first cause of a fall: longer than a step
LONG_ENOUGH_S = PERSISTENCE_TICKS * TIMESTEP_S  # as for every limit: single ticks are contact noise


class AnkleStopTally:
    """Counts the ticks in which an ankle of a loaded foot has left its range, as the limit ``joint_range`` does.

    Args:
        robot: ranges of the joints.
    """

    def __init__(self, robot: RobotDescription) -> None:
        self._ankles = [[(dof, *_range(robot, dof)) for dof in (foot.sagittal, foot.frontal)] for foot in robot.feet]
        self._at_s: list[float] = []

    def add(self, terms: DynamicsTerms, balance: BalanceMeasurement) -> None:
        """One tick: the dynamics at its state and the forces of the step made from there."""
        for ankle, force in zip(self._ankles, balance.normal_forces, strict=True):
            if force > SUPPORT_LOST_N and any(
                not lower <= terms.state.q[dof + 1] <= upper for dof, lower, upper in ankle
            ):
                self._at_s.append(terms.state.time_s)
                return

    @property
    def time_s(self) -> float:
        """In the whole episode [s]."""
        return len(self._at_s) * TIMESTEP_S

    def before(self, time_s: float) -> float:
        """In the last second before this time [s]."""
        return sum(time_s - BEFORE_S < at_s <= time_s for at_s in self._at_s) * TIMESTEP_S


def _range(robot: RobotDescription, dof: int) -> tuple[float, float]:
    """From where to where [rad] the joint is not at its stop."""
    lower, upper = robot.joint_lower[dof - BASE_DOFS], robot.joint_upper[dof - BASE_DOFS]
    return float(lower) - RANGE_SLACK_RAD, float(upper) + RANGE_SLACK_RAD
