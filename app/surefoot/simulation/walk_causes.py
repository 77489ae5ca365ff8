"""What brought a walk down: the first fault within 2.5 s before the fall."""

import math

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.footsteps import Footstep, feet_now, step_limits
from surefoot.gait.progress import Phase
from surefoot.gait.scale import gait_scale
from surefoot.gait.touchdown import TOUCH_N
from surefoot.gait.walk import Walk
from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.momentum.capture_region import StepReach, capture_region_1, led_into
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.sizes import Sizes
from surefoot.simulation.falls import (
    FOOT_LOST_N,
    PERSISTENCE_TICKS,
    STOPPING,
    SUPPORT_LOST_N,
    LimitEvent,
    fall_cause_text,
)
from surefoot.simulation.measurement import BalanceMeasurement
from surefoot.simulation.physics import TIMESTEP_S
from surefoot.simulation.plant import FootTruth

# Lengths, times and forces are Bip's, other robots' in proportion
WINDOW_S = 2.5  # a robot that trips or cannot reach struggles for up to 2.2 s; what was longer ago was survived
FAR_M = 0.05  # a foot that comes down on a stone of 30 mm is nearer to its place
LATE_S = 0.15  # by then G has gone half as far again from the foot that stands as when the landing was expected
STRAIGHT_RAD = math.radians(1.0)  # before the end of the knee's range, which is what counts as straight
SLID_M = 0.03  # three times what is noted as the limit of the same name
TIPPED_RAD = math.radians(15.0)  # one that settles across 80 mm, on a stone of 15 mm below its edge, turns by 11
_CAPTURE_TICKS = 20  # a region costs half as much as a whole tick, and a fall takes a second

TRIP, LATE_LANDING, OUT_OF_REACH = "trip", "late_landing", "out_of_reach"
SLIP, TIPPED_SOLE, MISSED_CAPTURE = "slip", "tipped_sole", "missed_capture"


def walk_cause_texts(sizes: Sizes) -> dict[str, str]:
    """What the first causes of a walk's own mean, with the numbers of a robot of that size."""
    far_mm, slid_mm = (1e3 * length * sizes.leg for length in (FAR_M, SLID_M))
    late_s = round(LATE_S * math.sqrt(sizes.com_height), 3)
    loaded = f"a sole that carried more than {SUPPORT_LOST_N * sizes.weight:.0f} N"
    return {
        TRIP: f"the swing foot met more than {TOUCH_N * sizes.weight:.0f} N over {far_mm:.0f} mm from its place",
        LATE_LANDING: f"the swing foot found no ground within {late_s:g} s after its time",
        OUT_OF_REACH: f"a leg was stretched to within {math.degrees(STRAIGHT_RAD):.0f} degree of straight",
        SLIP: f"{loaded} slid by {slid_mm:.0f} mm",
        TIPPED_SOLE: f"{loaded} tilted by {math.degrees(TIPPED_RAD):.0f} degrees from how it was set down",
        MISSED_CAPTURE: "the capture point left what the next step can catch, or the soles where no step is to come",
    }


def first_cause_text(name: str, sizes: Sizes) -> str:
    """What a first cause means: one of a walk's own, or a fall's."""
    return walk_cause_texts(sizes).get(name) or fall_cause_text(name, sizes)


class WalkWatch:
    """Notes when something goes wrong in a walk.

    Each must last five ticks, but a landing far from its place and a missed capture.

    Args:
        robot: the robot.
        walk: the gait that walks.
    """

    def __init__(self, robot: RobotDescription, walk: Walk) -> None:
        self._robot, self._walk, self._scale = robot, walk, gait_scale(robot)
        self._far_m, self._slid_m = FAR_M * self._scale.length, SLID_M * self._scale.length
        self._late_s, self._loaded_n = LATE_S * self._scale.time, SUPPORT_LOST_N * self._scale.force
        ends = (robot.joint_lower, robot.joint_upper)
        self._straight = [
            float(min(sign * end[dof - BASE_DOFS] for end in ends)) + STRAIGHT_RAD for dof, sign in robot.knees
        ]
        self._running: dict[str, int] = {}
        self._noted: list[LimitEvent] = []
        self._set_down: dict[int, tuple[np.ndarray, np.ndarray]] = {}  # place and upward normal of a loaded sole
        self._step: Footstep | None = None  # that is being made
        self._made = 0  # steps before it
        self._airborne = False  # its foot has been free since it was lifted
        self._ticks = 0

    def first_cause(self, fall_cause: str, time_s: float) -> LimitEvent:
        """Name and time [s] of what came first on the way to a fall.

        Args:
            fall_cause: as ``falls.fall_cause`` names it; it is the first cause too where nothing went wrong before, and
                where no step could be made any more.
            time_s: of the fall [s].
        """
        if fall_cause not in STOPPING:
            for event in self._noted:
                if event.time_s >= time_s - WINDOW_S:
                    return event
        return LimitEvent(fall_cause, time_s)

    def update(
        self,
        terms: DynamicsTerms,
        balance: BalanceMeasurement,
        truth: tuple[FootTruth, FootTruth],
        capture: np.ndarray,
        omega: float,
    ) -> None:
        """Look at one tick.

        Args:
            terms: at the tick's state.
            balance: forces of the step that was made from there.
            truth: both feet in that step.
            capture: capture point (2,) in world [m].
            omega: natural frequency [rad/s].
        """
        now, feet = terms.state.time_s, feet_now(self._robot, terms)
        walk, swinging = self._walk, self._walk.swinging
        overdue = swinging is not None and now - walk.began_s > walk.timing.single_s + self._late_s
        moved = self._moved(terms, feet, balance, swinging)
        faults = {
            LATE_LANDING: overdue,
            OUT_OF_REACH: any(
                sign * terms.state.q[dof + 1] < limit
                for (dof, sign), limit in zip(self._robot.knees, self._straight, strict=True)
            ),
            SLIP: any(way > self._slid_m for way, _ in moved),
            TIPPED_SOLE: any(tilt > TIPPED_RAD for _, tilt in moved),
            TRIP: self._held_up(feet, truth),
        }
        for name, is_so in faults.items():
            count = self._running[name] = self._running.get(name, 0) + 1 if is_so else 0
            if count == PERSISTENCE_TICKS:
                self._note(name, now - (PERSISTENCE_TICKS - 1) * TIMESTEP_S)
        if self._has_landed_far(feet):
            self._note(TRIP, now)
        if self._ticks % _CAPTURE_TICKS == 0:
            missed = self._margin(terms, capture, omega) < 0.0
            if missed and not self._running.get(MISSED_CAPTURE):
                self._note(MISSED_CAPTURE, now)
            self._running[MISSED_CAPTURE] = int(missed)
        self._ticks += 1

    def _note(self, name: str, time_s: float) -> None:
        self._noted = [event for event in self._noted if event.time_s >= time_s - WINDOW_S]
        self._noted.append(LimitEvent(name, time_s))
        self._noted.sort(key=lambda event: event.time_s)

    def _held_up(self, feet: tuple[Footstep, Footstep], truth: tuple[FootTruth, FootTruth]) -> bool:
        """Whether the foot in the air is held, in any direction, while it is far from its place."""
        swinging = self._walk.swinging
        if swinging is None:
            return False
        step = self._walk.steps_ahead[0]  # where it is to land by now
        if self._step is None or self._made != self._walk.made:
            self._airborne, self._made = False, self._walk.made
        self._step = step
        force = math.hypot(*truth[swinging].force.tolist())
        self._airborne = self._airborne or force < FOOT_LOST_N * self._scale.force
        return self._airborne and force > TOUCH_N * self._scale.force and _away(feet, step) > self._far_m

    def _has_landed_far(self, feet: tuple[Footstep, Footstep]) -> bool:
        """Whether the walk counts its step as made in this tick, far from its place."""
        step = self._step
        if step is None or self._walk.swinging is not None:
            return False
        self._step = None
        return _away(feet, step) > self._far_m

    def _moved(
        self,
        terms: DynamicsTerms,
        feet: tuple[Footstep, Footstep],
        balance: BalanceMeasurement,
        swinging: int | None,
    ) -> list[tuple[float, float]]:
        """Of each sole that carries a load: how far it has slid [m] and tilted [rad] since it began to."""
        moved = []
        for foot, now in zip(feet, terms.feet, strict=True):
            if foot.foot == swinging or balance.normal_forces[foot.foot] <= self._loaded_n:
                self._set_down.pop(foot.foot, None)
                continue
            up = now.rotation_foot_to_world[:, 2]
            place, was_up = self._set_down.setdefault(foot.foot, (foot.point, up.copy()))
            tilt = math.acos(min(1.0, float(up.dot(was_up))))
            moved.append((math.hypot(*(foot.point - place).tolist()), tilt))
        return moved

    def region(self, terms: DynamicsTerms, omega: float) -> tuple[ConvexPolygon, Footstep | None, float]:
        """Where the capture point can be caught now.

        Args:
            terms: at the tick's state.
            omega: natural frequency [rad/s].

        Returns:
            The region [m], the foot whose axes and point below the ankle it is in (None: world), and the time until the
            next step lands as planned [s], NaN where none is to come: the soles are the region then.
        """
        now, feet, walk = terms.state.time_s, feet_now(self._robot, terms), self._walk
        if walk.phase in (Phase.WAITING, Phase.STANDING) or not walk.steps_ahead:
            return self._soles(feet), None, math.nan
        stance = feet[1 - walk.steps_ahead[0].foot]
        since_s, timing = now - walk.began_s, walk.timing
        if walk.phase is Phase.SINGLE:
            left_s = max(timing.single_s - since_s, 0.0)
            return self._caught_on(stance, omega, left_s), stance, left_s
        from_both = self._soles(feet).moved(stance.axes.T, -stance.point.dot(stance.axes))
        alone = self._caught_on(stance, omega, timing.single_s)
        left_s = max(timing.double_s - since_s, 0.0)
        return led_into(alone, from_both, omega, left_s), stance, left_s + timing.single_s

    def _margin(self, terms: DynamicsTerms, capture: np.ndarray, omega: float) -> float:
        """How far inside the region that can be caught the capture point is [m]; negative outside."""
        region, stance, _ = self.region(terms, omega)
        return region.signed_margin(capture if stance is None else (capture - stance.point).dot(stance.axes))

    def _caught_on(self, stance: Footstep, omega: float, landing_s: float) -> ConvexPolygon:
        """K_1 in the axes of the foot that stands, for a step to anywhere that a step may be planned to."""
        side, feet = (1.0 if stance.foot == 1 else -1.0), self._robot.feet
        along, across = step_limits(self._scale)
        places = convex_hull((ahead, side * aside) for ahead in along for aside in across)
        reach = StepReach(places=places, sole=feet[1 - stance.foot].sole, landing_s=landing_s)
        return capture_region_1(feet[stance.foot].sole, reach, omega)

    def _soles(self, feet: tuple[Footstep, Footstep]) -> ConvexPolygon:
        """Hull of both [m] in world."""
        corners = [foot.point + self._robot.feet[foot.foot].sole.vertices.dot(foot.axes.T) for foot in feet]
        return convex_hull(np.vstack(corners).tolist())


def _away(feet: tuple[Footstep, Footstep], step: Footstep) -> float:
    """From a foot to where it is to be set down [m]."""
    return math.hypot(*(feet[step.foot].point - step.point).tolist())
