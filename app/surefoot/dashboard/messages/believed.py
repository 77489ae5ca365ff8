"""What the page shows of the robot as an estimator has it."""

from dataclasses import dataclass

import numpy as np

from surefoot.dynamics.terms import FootTerms
from surefoot.robot.description import RobotDescription


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BelievedRobot:
    """Where the robot is believed to be, world frame, metres; it may have drifted away from the true one.

    Attributes:
        qpos: (7 + n,) as in ``Geometry``.
        com: (3,) centre of mass.
        capture: (2,) capture point; NaN where unknown.
        soles: (2, n, 3) corners of both soles.
    """

    qpos: np.ndarray
    com: np.ndarray
    capture: np.ndarray
    soles: np.ndarray


def soles_of(robot: RobotDescription, feet: tuple[FootTerms, FootTerms]) -> np.ndarray:
    """(2, n, 3) corners of both soles in world [m], where a state's dynamics have the feet."""
    corners = [
        at.position_ankle_in_world + foot.corners_from_ankle.dot(at.rotation_foot_to_world.T)
        for foot, at in zip(robot.feet, feet, strict=True)
    ]
    return np.stack(corners)
