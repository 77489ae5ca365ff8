"""The emergency step: a foot is set down where the capture point will be, when no ankle can bring it back any more."""

import math
from dataclasses import replace

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.dcm_plan import NO_PLAN
from surefoot.gait.footsteps import Footstep, StepTiming, feet_now
from surefoot.gait.progress import Phase, Progress
from surefoot.gait.walk import Walk
from surefoot.gait.zmp_plan import REST_FORWARD_M
from surefoot.geometry.polygon import ConvexPolygon, convex_hull, project_onto_halfplanes
from surefoot.momentum.capture_region import StepReach, capture_region_1
from surefoot.momentum.zmp import capture_point, natural_frequency
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference

# Found by trial, with pushes from two feet and from one, in steps of 45 degrees
LANDING_S = 0.3  # from the decision until the foot stands
LIFT_M = 0.04
MARGIN_M = 0.01  # the capture point is so near to the edge of the soles when a step is decided
HELPS_M = 0.005  # a step is made only where K_1 has the capture point so much deeper inside than the soles have
# Where a foot can be set down from the one that stands, in its axes
REACH_AHEAD_M, REACH_ASIDE_M = (-0.35, 0.45), (0.17, 0.38)
AIM_UNTIL = 0.75  # share of the swing after which the foot keeps its aim
_AIM_S = 0.03  # time constant with which the aim moves
_HEIGHT_STIFFNESS = 60.0  # 1/s2: G is as high as it was when the push came; 150 (as walks have it): 14 of 16 caught
_WIDTH_M = 0.22  # between the feet when the other foot has followed
_SHARE = 0.2  # of the time from landing to landing on two feet, as in a walk
_USED = 0.9  # share of the sole that the ZMP is counted on to use


def step_region(robot: RobotDescription, stance: int, omega: float) -> ConvexPolygon:
    """K_1 of the emergency step, in the axes of the foot that stands from the point below its ankle [m].

    Args:
        robot: the robot.
        stance: the foot that stands: 0 left, 1 right.
        omega: natural frequency [rad/s].
    """
    side = 1.0 if stance == 1 else -1.0
    places = convex_hull((ahead, side * aside) for ahead in REACH_AHEAD_M for aside in REACH_ASIDE_M)
    reach = StepReach(places=places, sole=robot.feet[1 - stance].sole, landing_s=LANDING_S)
    return capture_region_1(robot.feet[stance].sole, reach, omega)


class StepWhenNeeded:
    """Holds what it is told to until the capture point leaves the soles; then steps, and stands there.

    The foot in the air steps; from two feet the one whose step leaves the capture point deeper in K_1. It lands where
    the capture point is expected, which is looked at again in every tick; the other foot follows, and is set down
    beside it or where the capture point needs it. Where that was not enough, the next step begins.

    Args:
        robot: the robot.
        posture: where it stands at the start.

    Attributes:
        made: steps that have landed.
    """

    def __init__(self, robot: RobotDescription, posture: TaskReference) -> None:
        self.made = 0
        self._robot, self._posture = robot, posture
        self._support = posture.support
        self._walk: Walk | None = None
        self._last_s = 0.0

    @property
    def standing(self) -> tuple[int, ...]:
        """The feet that are to keep their load now."""
        return self._walk.standing if self._walk else self._support.stance

    @property
    def steps_ahead(self) -> tuple[Footstep, ...]:
        """The steps that have been decided."""
        return self._walk.steps_ahead if self._walk else ()

    @property
    def plan_ahead(self) -> np.ndarray:
        """That of the steps that have been decided."""
        return self._walk.plan_ahead if self._walk else NO_PLAN

    @property
    def progress(self) -> Progress:
        """How many steps it has made; planned are those that have been decided too."""
        planned = self.made + len(self.steps_ahead)
        if self._walk is None:
            alone = self._support.reference_foot if self._support is not Support.DOUBLE else None
            return Progress(phase=Phase.WAITING, alone=alone, made=self.made, planned=planned)
        return replace(self._walk.progress, made=self.made, planned=planned, pace=None)

    @property
    def stances(self) -> tuple[int, ...]:
        """The feet that may stand while the other one steps; none while a step is being made."""
        if self._walk is None:
            return self._support.stance
        return () if self._walk.phase is Phase.SINGLE else (0, 1)

    def tick(self, terms: DynamicsTerms, sensing: FootSensing, held: TaskReference) -> TaskReference:
        """What is wanted in this tick, from where the robot is and what its feet feel."""
        now, walk = terms.state.time_s, self._walk
        omega = natural_frequency(float(terms.position_com_in_world[2]), self._robot.gravity)
        capture = capture_point(terms.position_com_in_world, terms.velocity_com_in_world, omega)
        if walk is not None and walk.phase is Phase.SINGLE:
            self._aim(walk, now, terms, capture, omega)
        else:
            stance = self._stance_to_step_from(terms, capture, omega)
            if stance is not None:
                walk = self._walk = self._begin(now, terms, stance)
        self._last_s = now
        if walk is None:
            return held
        made, reference = walk.made, walk.tick(terms, sensing, held)
        self.made += walk.made - made
        return reference

    def _stance_to_step_from(self, terms: DynamicsTerms, capture: np.ndarray, omega: float) -> int | None:
        """The foot that is to stand while the other one steps; None while no step is needed, or none would help."""
        stances = self.stances
        without = self._soles(terms, stances).signed_margin(capture)
        if without >= MARGIN_M:
            return None
        feet = feet_now(self._robot, terms)
        margins = [
            step_region(self._robot, i, omega).signed_margin((capture - feet[i].point).dot(feet[i].axes))
            for i in stances
        ]
        best = max(margins)
        return stances[margins.index(best)] if best > without + HELPS_M else None

    def _begin(self, now: float, terms: DynamicsTerms, stance: int) -> Walk:
        feet = feet_now(self._robot, terms)
        step = self._placed(feet[stance], feet[1 - stance].point)
        height = float(self._posture.position_com[2])
        left, right = (foot.position_ankle_in_world.copy() for foot in terms.feet)
        posture = replace(
            self._posture,
            support=Support.DOUBLE,
            position_com=np.array((*terms.position_com_in_world[:2], height)),
            position_ankles=(left, right),
        )
        timing = StepTiming(
            start_s=now, period_s=LANDING_S / (1.0 - _SHARE), double_support_share=_SHARE, lift_m=LIFT_M
        )
        steps = [step, self._beside(step)]
        walk = Walk(
            self._robot, posture, steps, timing, reserve_m=0.0, height_stiffness=_HEIGHT_STIFFNESS, adjusts=False
        )
        walk.step_now(now, terms)
        return walk

    def _aim(self, walk: Walk, now: float, terms: DynamicsTerms, capture: np.ndarray, omega: float) -> None:
        rest_s = LANDING_S - (now - walk.began_s)
        if rest_s < (1.0 - AIM_UNTIL) * LANDING_S:
            return
        step = walk.footsteps[walk.made]
        stance = feet_now(self._robot, terms)[1 - step.foot]
        sole = self._soles(terms, (stance.foot,)).scaled(_USED)
        zmp = project_onto_halfplanes(capture, sole.normals, sole.offsets)
        zmp = sole.centroid if zmp is None else zmp
        landing = zmp + (capture - zmp) * math.exp(omega * rest_s) - REST_FORWARD_M * stance.axes[:, 0]
        share = min(1.0, (now - self._last_s) / _AIM_S)
        step = self._placed(stance, step.point + share * (self._placed(stance, landing).point - step.point))
        walk.aim(stance, *((step, self._beside(step)) if walk.made == 0 else (step,)))

    def _placed(self, stance: Footstep, point: np.ndarray) -> Footstep:
        """The place nearest to a point that the other foot can reach."""
        ahead, left = (point - stance.point).dot(stance.axes).tolist()
        side = 1.0 if stance.foot == 1 else -1.0
        ahead = min(max(ahead, REACH_AHEAD_M[0]), REACH_AHEAD_M[1])
        aside = min(max(side * left, REACH_ASIDE_M[0]), REACH_ASIDE_M[1])
        return Footstep(1 - stance.foot, stance.point + stance.axes.dot((ahead, side * aside)), stance.yaw_rad)

    def _beside(self, step: Footstep) -> Footstep:
        """The other foot, set down next to it."""
        side = -1.0 if step.foot == 0 else 1.0
        return Footstep(1 - step.foot, step.point + side * _WIDTH_M * step.axes[:, 1], step.yaw_rad)

    def _soles(self, terms: DynamicsTerms, feet: tuple[int, ...]) -> ConvexPolygon:
        """Hull of the soles, seen from above [m]."""
        corners = [
            terms.feet[i].position_ankle_in_world
            + self._robot.feet[i].corners_from_ankle.dot(terms.feet[i].rotation_foot_to_world.T)
            for i in feet
        ]
        return convex_hull(np.vstack(corners)[:, :2].tolist())
