"""Where an emergency step goes: which foot is to stand, and where the other one is set down."""

import math

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.footsteps import Footstep, StepTiming, feet_now
from surefoot.gait.scale import GaitScale, gait_scale
from surefoot.gait.walk import Walk
from surefoot.gait.zmp_plan import REST_FORWARD_M
from surefoot.geometry.polygon import ConvexPolygon, convex_hull, project_onto_halfplanes
from surefoot.momentum.capture_region import StepReach, capture_region_1
from surefoot.robot.description import RobotDescription

# Found by trial with Bip, pushed on two feet and on one, in steps of 45 degrees; other robots' in proportion
LANDING_S = 0.3  # from the decision until the foot stands
# The foot that follows swings so long where the capture point is as safe without its landing: swung aside within 0.3 s
# it was seen to drive that point after it by 40 mm, half of a sole's width; in twice the time by half of that
FOLLOWS_S = 0.6
LIFT_M = 0.04
MARGIN_M = 0.01  # the capture point is so near to the edge of the soles when a step is decided
HELPS_M = 0.005  # a step is made only where K_1 has the capture point so much deeper inside than the soles have
# Where a foot can be set down from the one that stands, in its axes
REACH_AHEAD_M, REACH_ASIDE_M = (-0.35, 0.45), (0.17, 0.38)
AIM_UNTIL = 0.75  # share of the swing after which the foot keeps its aim
_AIM_S = 0.03  # time constant with which the aim moves
STEP_HEIGHT_STIFFNESS = 60.0  # 1/s2: G is as high as it was when the push came; 150 (as walks have it): 14 of 16 caught
_WIDTH_M = 0.22  # between the feet when the other foot has followed
# Feet farther apart along the heading are no place to stand: the other foot follows. Bip's hind ankle is 0.19 rad from
# its stop there, and at it from 0.4 m on where G is still as low as the step needed: the sole then stands on its toe
STANDS_M = 0.2
_SHARE = 0.2  # of the time from landing to landing on two feet, as in a walk
_USED = 0.9  # share of the sole that the ZMP is counted on to use


def landing_time(robot: RobotDescription) -> float:
    """From the decision for an emergency step until its foot stands [s]."""
    return LANDING_S * gait_scale(robot).time


def step_reach(robot: RobotDescription) -> tuple[tuple[float, float], tuple[float, float]]:
    """Least and greatest way of an emergency step ahead and outward from the foot that stands [m]."""
    scale = gait_scale(robot)
    return scale.lengths(REACH_AHEAD_M), scale.widths(REACH_ASIDE_M)


def step_region(robot: RobotDescription, stance: int, omega: float) -> ConvexPolygon:
    """K_1 of the emergency step, in the axes of the foot that stands from the point below its ankle [m].

    Args:
        robot: the robot.
        stance: the foot that stands: 0 left, 1 right.
        omega: natural frequency [rad/s].
    """
    side = 1.0 if stance == 1 else -1.0
    (along, across), landing_s = step_reach(robot), landing_time(robot)
    places = convex_hull((ahead, side * aside) for ahead in along for aside in across)
    reach = StepReach(places=places, sole=robot.feet[1 - stance].sole, landing_s=landing_s)
    return capture_region_1(robot.feet[stance].sole, reach, omega)


def step_timing(start_s: float, scale: GaitScale, landing_s: float = LANDING_S) -> StepTiming:
    """Of emergency steps: the first one is lifted at once.

    Args:
        start_s: of the walk that they belong to [s].
        scale: of the robot.
        landing_s: Bip's time from lift-off to landing [s].
    """
    period_s, lift_m = landing_s * scale.time / (1.0 - _SHARE), LIFT_M * scale.length
    return StepTiming(start_s=start_s, period_s=period_s, double_support_share=_SHARE, lift_m=lift_m)


class EmergencyStep:
    """Decides on emergency steps, each of which has the other foot follow, and aims them. It remembers nothing.

    Args:
        robot: the robot.
    """

    def __init__(self, robot: RobotDescription) -> None:
        self._robot, self._scale = robot, gait_scale(robot)
        self._reach = step_reach(robot)

    def stance_to_step_from(
        self, terms: DynamicsTerms, stances: tuple[int, ...], capture: np.ndarray, omega: float
    ) -> int | None:
        """The foot that is to stand while the other one steps; None while no step is needed, or none would help.

        Args:
            terms: at the tick's state.
            stances: the feet that stand and may do so alone; none: no step can be made.
            capture: capture point (2,) in world [m].
            omega: natural frequency [rad/s].
        """
        if not stances:
            return None
        without = self._soles(terms, stances).signed_margin(capture)
        if without >= MARGIN_M * self._scale.sole:
            return None
        margins = [self._margin_alone(terms, i, capture, omega) for i in stances]
        best = max(margins)
        return stances[margins.index(best)] if best > without + HELPS_M * self._scale.sole else None

    def steps_from(self, terms: DynamicsTerms, stance: int) -> tuple[Footstep, Footstep]:
        """The step as it is begun, before it is aimed, and the other foot's after it."""
        feet = feet_now(self._robot, terms)
        step = self._placed(feet[stance], feet[1 - stance].point)
        return step, self._beside(step)

    def follow_in_time(self, walk: Walk, terms: DynamicsTerms, capture: np.ndarray, omega: float) -> None:
        """Let the foot that is about to follow take its time, where to hurry would buy nothing.

        Args:
            walk: makes the steps, and stands on both feet.
            terms: at the tick's state.
            capture: capture point (2,) in world [m].
            omega: natural frequency [rad/s].
        """
        stance = 1 - walk.steps_ahead[0].foot
        alone = self._soles(terms, (stance,)).signed_margin(capture)
        hurries = self._margin_alone(terms, stance, capture, omega) > alone + HELPS_M * self._scale.sole
        walk.timing = step_timing(walk.timing.start_s, self._scale, LANDING_S if hurries else FOLLOWS_S)

    def aim(self, walk: Walk, elapsed_s: float, terms: DynamicsTerms, capture: np.ndarray, omega: float) -> None:
        """Let the step that is being made land where the capture point is expected then.

        The last one has the other foot follow too where it is to land far ahead of the foot that stands, or behind it.

        Args:
            walk: makes it; it and, where there is one, the step that follows are all that is to come.
            elapsed_s: since it was aimed before [s].
            terms: at the tick's state.
            capture: capture point (2,) in world [m].
            omega: natural frequency [rad/s].
        """
        lasts_s = walk.timing.single_s
        rest_s = lasts_s - (terms.state.time_s - walk.began_s)
        if rest_s < (1.0 - AIM_UNTIL) * lasts_s:
            return
        step = walk.footsteps[walk.made]
        stance = feet_now(self._robot, terms)[1 - step.foot]
        sole = self._soles(terms, (stance.foot,)).scaled(_USED)
        zmp = project_onto_halfplanes(capture, sole.normals, sole.offsets)
        zmp = sole.centroid if zmp is None else zmp
        landing = (
            zmp
            + (capture - zmp) * math.exp(omega * rest_s)
            - REST_FORWARD_M * self._scale.sole_middle * stance.axes[:, 0]
        )
        share = min(1.0, elapsed_s / (_AIM_S * self._scale.time))
        step = self._placed(stance, step.point + share * (self._placed(stance, landing).point - step.point))
        follows = len(walk.footsteps) - walk.made > 1 or self._parts_feet(stance, step)
        walk.aim(stance, *((step, self._beside(step)) if follows else (step,)))

    def _margin_alone(self, terms: DynamicsTerms, stance: int, capture: np.ndarray, omega: float) -> float:
        """How far inside a foot's K_1 the capture point is [m]; negative outside."""
        foot = feet_now(self._robot, terms)[stance]
        return step_region(self._robot, stance, omega).signed_margin((capture - foot.point).dot(foot.axes))

    def _placed(self, stance: Footstep, point: np.ndarray) -> Footstep:
        """The place nearest to a point that the other foot can reach."""
        ahead, left = (point - stance.point).dot(stance.axes).tolist()
        side, (along, across) = 1.0 if stance.foot == 1 else -1.0, self._reach
        ahead = min(max(ahead, along[0]), along[1])
        aside = min(max(side * left, across[0]), across[1])
        return Footstep(1 - stance.foot, stance.point + stance.axes.dot((ahead, side * aside)), stance.yaw_rad)

    def _parts_feet(self, stance: Footstep, step: Footstep) -> bool:
        """Whether the feet would be too far apart along the heading to stand so."""
        return abs(float((step.point - stance.point).dot(stance.axes[:, 0]))) > STANDS_M * self._scale.length

    def _beside(self, step: Footstep) -> Footstep:
        """The other foot, set down next to it."""
        side = -1.0 if step.foot == 0 else 1.0
        return Footstep(1 - step.foot, step.point + side * _WIDTH_M * self._scale.width * step.axes[:, 1], step.yaw_rad)

    def _soles(self, terms: DynamicsTerms, feet: tuple[int, ...]) -> ConvexPolygon:
        """Hull of the soles, seen from above [m]."""
        corners = [
            terms.feet[i].position_ankle_in_world
            + self._robot.feet[i].corners_from_ankle.dot(terms.feet[i].rotation_foot_to_world.T)
            for i in feet
        ]
        return convex_hull(np.vstack(corners)[:, :2].tolist())
