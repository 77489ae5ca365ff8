"""Where the feet are to be set down, one step after the other, and when."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.errors import InvalidInput
from surefoot.gait.scale import BIP, GaitScale
from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.record import record
from surefoot.robot.description import RobotDescription


@record
class Footstep:
    """One foot on the ground.

    Attributes:
        foot: 0 left, 1 right.
        point: P, the point of the sole below the ankle (2,) in world [m].
        yaw_rad: heading.
    """

    foot: int
    point: np.ndarray
    yaw_rad: float

    @property
    def axes(self) -> np.ndarray:
        """Forward and left (2, 2): the foot's heading frame -> world."""
        return _axes(self.yaw_rad)


@dataclass(frozen=True, kw_only=True)
class StepTiming:
    """When steps are made, and how high.

    Attributes:
        start_s: when the weight begins to shift [s].
        period_s: from touch-down to touch-down [s].
        double_support_share: part of it on two feet, 0 to 1.
        lift_m: how high the foot is lifted [m].
    """

    start_s: float
    period_s: float
    double_support_share: float
    lift_m: float

    @property
    def double_s(self) -> float:
        """Time on two feet in each step [s]."""
        return self.double_support_share * self.period_s

    @property
    def single_s(self) -> float:
        """Time on one foot in each step [s]."""
        return self.period_s - self.double_s


@dataclass(frozen=True, kw_only=True)
class Pace:
    """What even steps are like.

    Attributes:
        length_m: how far each is ahead of the foot that stands.
        width_m: between the feet, across the heading.
        turn_rad: heading gained in each, positive to the left.
    """

    length_m: float
    width_m: float
    turn_rad: float = 0.0


def plan_footsteps(
    feet: tuple[Footstep, Footstep],
    *,
    steps: int,
    length_m: float,
    width_m: float,
    turn_rad: float = 0.0,
    first_foot: int = 0,
) -> list[Footstep]:
    """Even steps along an arc; the last one sets the feet beside each other.

    Args:
        feet: left and right, where they stand.
        steps: how many, the closing one included.
        length_m: how far each step is ahead of the foot that stands.
        width_m: between the feet, across the heading.
        turn_rad: heading gained in each step, positive to the left.
        first_foot: which foot steps first: 0 left, 1 right.
    """
    centre = 0.5 * (feet[0].point + feet[1].point)
    yaw = 0.5 * (feet[0].yaw_rad + feet[1].yaw_rad)
    planned, foot = [], first_foot
    for number in range(1, steps + 1):
        if number < steps or steps == 1:
            yaw += turn_rad
            centre = centre + length_m * _axes(yaw)[:, 0]
        aside = 0.5 * width_m if foot == 0 else -0.5 * width_m
        planned.append(Footstep(foot, centre + aside * _axes(yaw)[:, 1], yaw))
        foot = 1 - foot
    return planned


def feet_now(robot: RobotDescription, terms: DynamicsTerms) -> tuple[Footstep, Footstep]:
    """Left and right foot where they are, with the headings that they have."""
    left, right = (
        Footstep(
            i,
            foot.point_below(now.position_ankle_in_world, now.rotation_foot_to_world)[:2],
            yaw_of(now.rotation_foot_to_world),
        )
        for i, (now, foot) in enumerate(zip(terms.feet, robot.feet, strict=True))
    )
    return left, right


def sole_height(robot: RobotDescription, terms: DynamicsTerms, foot: int) -> float:
    """Height of the point below a foot's ankle [m]."""
    now = terms.feet[foot]
    return float(robot.feet[foot].point_below(now.position_ankle_in_world, now.rotation_foot_to_world)[2])


def yaw_of(rotation: np.ndarray) -> float:
    """Heading [rad] of the first axis of a rotation to the world (3, 3)."""
    return math.atan2(float(rotation[1, 0]), float(rotation[0, 0]))


# As far as a foot may be set down from the one that stands, in that one's axes: no narrower than Bip's soles pass each
# other, no further than its legs, 0.9 m long, could ever reach; other robots' in proportion. Whether it is walked, a
# run shows.
NARROWEST_M = 0.16
AHEAD_M, ASIDE_M = (-0.5, 0.6), (NARROWEST_M, 0.5)


def step_limits(scale: GaitScale) -> tuple[tuple[float, float], tuple[float, float]]:
    """Least and greatest way of a step ahead and outward from the foot that stands [m]."""
    return scale.lengths(AHEAD_M), scale.widths(ASIDE_M)


def check_footsteps(feet: Sequence[Footstep], steps: Sequence[Footstep], scale: GaitScale = BIP) -> None:
    """Refuse a step that overlaps the foot that stands, crosses it, or is too far away.

    Args:
        feet: left and right, where they stand.
        steps: in the order in which they are made.
        scale: of the robot.

    Raises:
        InvalidInput: naming the first such step.
    """
    places, within = list(feet), step_limits(scale)
    for i, step in enumerate(steps):
        stance = places[1 - step.foot]
        ahead, left = (step.point - stance.point).dot(stance.axes).tolist()
        aside = left if step.foot == 0 else -left
        for name, value, (low, high) in (("x_m", ahead, within[0]), ("y_m", aside, within[1])):
            if not low <= value <= high:
                where = "ahead of" if name == "x_m" else "outward from"
                reason = f"it would be {value:.3f} m {where} the foot that stands"
                raise InvalidInput(f"footsteps.{i}.{name}", step.point.tolist(), reason, [f"{low:g} to {high:g} m"])
        places[step.foot] = step


def _axes(yaw_rad: float) -> np.ndarray:
    return rotation_from_rpy(0.0, 0.0, yaw_rad)[:2, :2]
