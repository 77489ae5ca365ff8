"""Supports on which a robot does not stand by the rule that Bip does: a posture of its own is looked for."""

from dataclasses import replace

import numpy as np

from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import PostureError
from surefoot.record import record
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.feet import Support
from surefoot.robot.stance import Stance
from surefoot.robot_import.posture_search import StanceSearch
from surefoot.task.posture import solve_posture, standing_reference


@record
class Load:
    """Of one joint.

    Attributes:
        joint: its name.
        share: of its torque limit; infinite: it stands beyond its range.
    """

    joint: str
    share: float


@record
class ByRule:
    """What is wrong with standing by rule.

    Attributes:
        worst: the joint in the way there; None: there is no such posture at all.
        least: the joint in the way in the posture that was found instead; None: none was found.
    """

    worst: Load | None = None
    least: Load | None = None

    @property
    def reason(self) -> str:
        """In words."""
        if self.worst is None:
            return "no posture by rule"
        asked = "is beyond its range" if np.isinf(self.worst.share) else f"needs {100.0 * self.worst.share:.0f} %"
        return f"by rule {self.worst.joint} {asked}"

    @property
    def remains(self) -> str:
        """What the search came to where it did not help, to go behind what is in the way."""
        if self.least is None:
            return "; no other posture was found"
        return f"; the search for another posture came to {100.0 * self.least.share:.0f} % of {self.least.joint}"


def with_stances(robot: RobotDescription, said: frozenset[str]) -> tuple[RobotDescription, dict[Support, ByRule]]:
    """The robot with a stance of its own for every support that needs one, if one is found; and why it was needed.

    A posture by rule that is within ranges and torque limits is kept, and so is one that cannot be helped.

    Args:
        robot: as it was read.
        said: names of joints in no leg whose angle a person has said: they stay.
    """
    dynamics = DynamicsModel(robot)
    held = frozenset(joint.dof for joint in robot.joints if joint.name in said and joint.dof in robot.upper)
    stances, why = {}, {}
    for support in Support:
        reference = standing_reference(robot, support)
        reached, q = _by_rule(dynamics, support)
        search = StanceSearch(dynamics, reference, q, held)
        worst = _worst(dynamics, search, q)
        if reached and worst.share <= 1.0:
            continue
        found, least = search.find(), None
        if found is not None:
            least = _worst(dynamics, StanceSearch(dynamics, reference, found, held), found)
            if least.share <= 1.0:
                stances[support] = _stance(dynamics, found)
        why[support] = ByRule(worst if reached else None, least)
    return replace(robot, stances=stances), why


def _by_rule(dynamics: DynamicsModel, support: Support) -> tuple[bool, np.ndarray]:
    """Whether the posture by rule is reached, and the configuration; else one to begin a search with."""
    robot, reference = dynamics.robot, standing_reference(dynamics.robot, support)
    try:
        return True, solve_posture(dynamics, reference).q
    except PostureError:
        q = dynamics.neutral(reference.position_com - np.array((0.0, 0.0, robot.sizes.base_below_com_m)))
        q[7:] = robot.start_angles
        return False, q


def _worst(dynamics: DynamicsModel, search: StanceSearch, q: np.ndarray) -> Load:
    """The joint that stands in the way most: beyond its range, else with the greatest share of its torque limit."""
    robot = dynamics.robot
    beyond = np.maximum(robot.joint_lower - q[7:], q[7:] - robot.joint_upper)
    if beyond.max() > 1e-6:
        return Load(robot.joints[int(beyond.argmax())].name, float("inf"))
    shares = np.abs(search.shares(np.zeros(robot.dofs)))
    return Load(robot.joints[int(shares.argmax())].name, float(shares.max()))


def _stance(dynamics: DynamicsModel, q: np.ndarray) -> Stance:
    terms = dynamics.evaluate(RobotState(q, np.zeros(dynamics.robot.dofs)))
    left, right = (foot.position_ankle_in_world for foot in terms.feet)
    return Stance(terms.position_com_in_world, terms.rotation_pelvis_to_world, (left, right), terms.upper_rad)
