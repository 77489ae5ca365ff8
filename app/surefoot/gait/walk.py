"""Walking: phases driven by the feet's forces, planned anew at each lift-off and touch-down from where the feet are."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from surefoot.dynamics.terms import FOOT_ROWS, DynamicsTerms
from surefoot.gait.com_feedback import HEIGHT_STIFFNESS, REACH_RESERVE_M, CoMFeedback
from surefoot.gait.dcm_plan import NO_PLAN, DCMPlan, ZMPPiece
from surefoot.gait.footsteps import Footstep, Pace, StepTiming, feet_now, sole_height, yaw_of
from surefoot.gait.pelvis_heading import PelvisHeading
from surefoot.gait.progress import Phase, Progress
from surefoot.gait.scale import gait_scale
from surefoot.gait.steering import first_stance, footsteps_from
from surefoot.gait.step_adjustment import LATE_FROM_S, StepAdjustment, hurry
from surefoot.gait.swing_foot import LANDING_SPEED_M_S, SwingFoot, swing_to
from surefoot.gait.touchdown import Touchdown
from surefoot.gait.weight_shift import shift_duration
from surefoot.gait.zmp_plan import braking_zmp, rest_in, zmp_ahead
from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.momentum.zmp import capture_point
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference

# Found by trial, walking Bip; not searched for further, here and in the other files of the gait: others in proportion
FIRST_SHIFT_S, LAST_SHIFT_S = 0.6, 0.5  # the weight shifts from two feet at rest to one, and back
STEPS_AHEAD = 4  # that a plan looks ahead
REACH_SHARE = 0.75  # of a step's length is G ahead of the hind foot when the step lands late
_ALONE = (Support.LEFT, Support.RIGHT)


class Walk:
    """Walks along planned footsteps, and stands after the last one.

    It decides G'', the swing foot's way, and which feet carry; nobody tells it the ground. A foot that lands early ends
    its swing at once; one that finds no ground goes on downwards, and one that has lost it again does too. It is
    called every tick and remembers.

    Args:
        robot: the robot.
        posture: where it stands at the start, on two feet.
        footsteps: where to step; at least one.
        timing: when, and how high.
        pace: of even footsteps, which a walk that is steered goes on with; None: on the spot.
        reserve_m: G goes so much less deep than a long step needs [m]: none where a push has taken it far ahead.
        height_stiffness: with which G keeps its height [1/s2]; Bip's both, other robots' in proportion.
        adjusts: steps land elsewhere and earlier where the capture point asks for it.

    Attributes:
        phase: what it is doing.
        began_s: since when [s]; of a swing that was hurried, as if it had gone on as fast from the start.
        made: steps that have landed.
        landed_s: when each of them has [s].
        led_to: where each of them was to be set down when it did, moved or not (2,), world [m].
        footsteps: all of them, as planned.
        timing: as given.
        pace: of the steps to come, as last asked for.
    """

    def __init__(
        self,
        robot: RobotDescription,
        posture: TaskReference,
        footsteps: Sequence[Footstep],
        timing: StepTiming,
        *,
        pace: Pace | None = None,
        reserve_m: float = REACH_RESERVE_M,
        height_stiffness: float = HEIGHT_STIFFNESS,
        adjusts: bool = True,
    ) -> None:
        self.phase, self.made, self.footsteps = Phase.WAITING, 0, tuple(footsteps)
        self.landed_s: tuple[float, ...] = ()
        self.led_to: tuple[np.ndarray, ...] = ()
        self.timing, self._robot, self._posture, self._scale = timing, robot, posture, gait_scale(robot)
        ankles = zip(posture.position_ankles, robot.feet, strict=True)
        sole = 0.5 * sum(float(ankle[2]) - foot.ankle_height_m for ankle, foot in ankles)
        height, stiffness, scale = float(posture.position_com[2]) - sole, height_stiffness, self._scale
        self._feedback = CoMFeedback(height, robot.gravity, stiffness=stiffness, reserve_m=reserve_m, scale=scale)
        self._adjustment, self._adjusts = StepAdjustment(self._feedback.omega, scale), adjusts
        self._yaws = [yaw_of(rotation) for rotation in posture.rotation_feet_to_world]  # as each foot was set down
        self._pelvis = PelvisHeading(0.5 * sum(self._yaws), scale)
        self._width_m = abs(float(posture.position_ankles[0][1] - posture.position_ankles[1][1]))
        self.pace = pace or Pace(length_m=0.0, width_m=self._width_m)
        self._ends = False  # the weight shifts to between both feet, or is there
        self._swing: SwingFoot | None = None
        self._touchdown, self._bounced = Touchdown(LANDING_SPEED_M_S * scale.speed, scale), False
        self._last_s, self.began_s, self._lasts_s = 0.0, 0.0, math.inf
        middle = posture.position_com[:2].copy()
        self._plan = DCMPlan([ZMPPiece(middle, middle, 1.0)], self._feedback.omega)

    @property
    def swinging(self) -> int | None:
        """The foot in the air, if there is one."""
        return self.footsteps[self.made].foot if self.phase is Phase.SINGLE else None

    @property
    def standing(self) -> tuple[int, ...]:
        """The feet that are to keep their load now."""
        leaves = self.phase in (Phase.DOUBLE, Phase.SINGLE) and self.made < len(self.footsteps)
        return (1 - self.footsteps[self.made].foot,) if leaves else (0, 1)

    @property
    def steps_ahead(self) -> tuple[Footstep, ...]:
        """The next steps, at most 4; one that is being made is the first of them."""
        return self._adjustment.steps(self.footsteps[self.made : self.made + STEPS_AHEAD])

    @property
    def plan_ahead(self) -> np.ndarray:
        """ZMP and capture point as planned (n, 4), now first; none where it only stands. See ``DCMPlan.ahead``."""
        moves = self.phase in (Phase.DOUBLE, Phase.SINGLE)
        return self._plan.ahead(self._last_s - self.began_s) if moves else NO_PLAN

    @property
    def progress(self) -> Progress:
        """How far it has come."""
        alone = None if self.swinging is None else 1 - self.swinging
        made, planned = self.made, len(self.footsteps)
        return Progress(phase=self.phase, alone=alone, made=made, planned=planned, left_s=self._left_s, pace=self.pace)

    @property
    def _left_s(self) -> float | None:
        if self.phase in (Phase.STANDING, Phase.WAITING):
            return None if self.phase is Phase.STANDING else self.timing.start_s - self._last_s
        return self.began_s + (self.timing.single_s if self.phase is Phase.SINGLE else self._lasts_s) - self._last_s

    def tick(self, terms: DynamicsTerms, sensing: FootSensing, held: TaskReference) -> TaskReference:
        """What is wanted in this tick, from where the robot is and what its feet feel."""
        now = terms.state.time_s
        self._bounced = self._has_bounced(now, sensing)
        self.began_s += now - self._last_s if self._bounced else 0.0  # the weight waits for it
        if (self.phase is Phase.WAITING and now >= self.timing.start_s) or (self._ends and self.steps_ahead):
            self._shift_weight(now, terms, FIRST_SHIFT_S * self._scale.time)
        elif self.phase is Phase.DOUBLE and now - self.began_s >= self._lasts_s:
            self._lift_or_stand(now, terms)
        elif self.phase is Phase.SINGLE and self._has_landed(now, sensing):
            step = self.steps_ahead[0]
            self._yaws[step.foot], self.led_to = step.yaw_rad, (*self.led_to, step.point)
            self.made, self.landed_s = self.made + 1, (*self.landed_s, now)
            self._adjustment.landed()
            lasts_s = self.timing.double_s if self.steps_ahead else LAST_SHIFT_S * self._scale.time
            self._shift_weight(now, terms, lasts_s)
        reference = self._reference(now, terms)
        self._last_s = now
        return reference

    def step_now(self, now: float, terms: DynamicsTerms) -> None:
        """Lift the foot of the next step at once, without shifting the weight before."""
        self._last_s = now
        self._feedback.follow_soles(sole_height(self._robot, terms, 1 - self.footsteps[self.made].foot), math.inf)
        self._lift_or_stand(now, terms)

    def aim(self, stance: Footstep, *steps: Footstep) -> None:
        """Set the coming steps down elsewhere; the foot in the air goes there from where it is.

        Args:
            stance: the foot that stands.
            steps: all that are to come.
        """
        self.footsteps = (*self.footsteps[: self.made], *steps)
        if self._swing is not None:
            self._swing.move_target(steps[0].point)
            self._lower_for(stance, steps[0])

    def steer(self, pace: Pace, steps: int | None = None) -> None:
        """Make other steps from the next lift-off on; the foot in the air is set down where it was to be.

        They go on from where the last step before them is planned, so that a walk that slips keeps its way. A robot
        that stands at its walk's end, or comes to stand, walks on.

        Args:
            pace: of these steps.
            steps: how many are to come, the closing one included; None: as many as are.
        """
        begun = self.made + (self.phase is Phase.SINGLE)
        self.pace, steps = pace, len(self.footsteps) - begun if steps is None else steps
        if steps > 0:
            ankles, foot, yaw = self._posture.position_ankles, 1 - self.footsteps[0].foot, 0.5 * sum(self._yaws)
            here = self.footsteps[begun - 1] if begun else first_stance(ankles, yaw, foot, pace)
            self.footsteps = (*self.footsteps[:begun], *footsteps_from(here, pace, steps))

    def stop(self) -> None:
        """Let the next step that is lifted set the feet beside each other, and be the last one."""
        if self.made + (self.phase is Phase.SINGLE) < len(self.footsteps):
            self.steer(self.pace, 1)

    def _has_landed(self, now: float, sensing: FootSensing) -> bool:
        force = sensing.normal_forces[self.footsteps[self.made].foot]
        return self._touchdown.has_landed(now, force, (now - self.began_s) / self.timing.single_s)

    def _has_bounced(self, now: float, sensing: FootSensing) -> bool:
        left, right = sensing.normal_forces
        forces = (left, right) if self.footsteps[self.made - 1].foot == 0 else (right, left)
        return self.phase is Phase.DOUBLE and self.made > 0 and self._touchdown.has_bounced(now, *forces)

    def _shift_weight(self, now: float, terms: DynamicsTerms, lasts_s: float) -> None:
        """To the foot that stands next, or between both after the last step."""
        feet, omega = self._feet(terms), self._feedback.omega
        zmp, _ = self._planned(now)
        self.phase, self.began_s, self._lasts_s, self._swing = Phase.DOUBLE, now, lasts_s, None
        self._ends = not (ahead := self.steps_ahead)
        if ahead:
            stance = feet[1 - ahead[0].foot]
            then = zmp_ahead(stance, ahead, self.timing, self._scale)
            if self.made > 0:
                capture = capture_point(terms.position_com_in_world, terms.velocity_com_in_world, omega)
                lasts_s = self._lasts_s = shift_duration(zmp, then, capture, omega, lasts_s, self._scale)
            pieces = [ZMPPiece(zmp, rest_in(stance, self._scale), lasts_s), *then]
        else:
            pieces = [ZMPPiece(zmp, np.mean([rest_in(foot, self._scale) for foot in feet], axis=0), lasts_s)]
        self._plan = DCMPlan(pieces, omega)

    def _lift_or_stand(self, now: float, terms: DynamicsTerms) -> None:
        ahead, feet = self.steps_ahead, self._feet(terms)
        if not ahead:
            self.phase, self._lasts_s = Phase.STANDING, math.inf
            return
        self._adjustment.lifted()
        step = ahead[0]
        stance, foot = feet[1 - step.foot], terms.feet[step.foot]
        self.phase, self.began_s, self._lasts_s = Phase.SINGLE, now, math.inf
        # as high as the foot that stands: level ground is expected
        height = sole_height(self._robot, terms, stance.foot) + self._robot.feet[step.foot].ankle_height_m
        self._swing = swing_to(step, height, foot, self.timing, self._scale)
        self._plan = DCMPlan(zmp_ahead(stance, ahead, self.timing, self._scale), self._feedback.omega)
        late_s, sole = self.timing.single_s, self._robot.feet[stance.foot].sole
        self._plan.wait(late_s, braking_zmp(stance, sole, self._plan.at(late_s)[1], self._scale))
        self._lower_for(stance, step)

    def _lower_for(self, stance: Footstep, step: Footstep) -> None:
        """Carry G so much lower that the hind leg still reaches the ground when the step lands."""
        ahead, left = (step.point - stance.point).dot(stance.axes).tolist()
        self._feedback.lower_for(REACH_SHARE * math.hypot(ahead, abs(left) - self._width_m))

    def _planned(self, now: float) -> tuple[np.ndarray, np.ndarray]:
        """ZMP and capture point (2,) in world [m] as they should be."""
        return self._plan.at(now - self.began_s)

    def _reference(self, now: float, terms: DynamicsTerms) -> TaskReference:
        swinging = self.swinging
        self._follow_soles(now, terms)
        zmp, capture = self._planned(now)
        com, com_velocity = terms.position_com_in_world, terms.velocity_com_in_world
        com_acceleration = self._feedback.acceleration(com, com_velocity, zmp, capture)
        off = capture - capture_point(com, com_velocity, self._feedback.omega)  # no place of G itself is wanted
        velocity, acceleration = np.zeros(self._robot.dofs), np.zeros(self._robot.dofs)
        ankles = [foot.position_ankle_in_world for foot in terms.feet]
        rotations = [rotation_from_rpy(0.0, 0.0, yaw) for yaw in self._yaws]
        support = Support.DOUBLE
        if self._swing is not None and swinging is not None:
            if self._adjusts:
                self._adjust(self._swing, now, terms, -off)
            motion = self._swing.at(now - self.began_s)
            rows, support = FOOT_ROWS[swinging], _ALONE[1 - swinging]
            ankles[swinging], rotations[swinging] = motion.position, motion.rotation
            velocity[rows], acceleration[rows] = motion.velocity, motion.acceleration
        elif self._bounced:
            foot = self.footsteps[self.made - 1].foot
            velocity[FOOT_ROWS[foot]][2], support = -self._touchdown.descent_m_s(now), _ALONE[1 - foot]
        return replace(
            self._posture,
            support=support,
            position_com=np.array((*(com[:2] + off), self._feedback.height_m)),
            rotation_pelvis_to_world=self._pelvis.turn(terms, now - self._last_s),
            position_ankles=(ankles[0], ankles[1]),
            rotation_feet_to_world=(rotations[0], rotations[1]),
            velocity=velocity,
            acceleration=acceleration,
            com_acceleration=com_acceleration,
        )

    def _follow_soles(self, now: float, terms: DynamicsTerms) -> None:
        """Keep G's height above what carries; where a foot is late, above that foot: it would not reach the ground."""
        swinging = self.swinging
        carrying = [sole_height(self._robot, terms, i) for i in range(2) if i != swinging]
        height, elapsed_s = sum(carrying) / len(carrying), now - self._last_s
        if swinging is not None and self._swing is not None and now - self.began_s > self.timing.single_s:
            sole = float(self._swing.at(now - self.began_s).position[2]) - self._robot.feet[swinging].ankle_height_m
            height, elapsed_s = min(height, sole), math.inf
        self._feedback.follow_soles(height, elapsed_s)

    def _adjust(self, swing: SwingFoot, now: float, terms: DynamicsTerms, error: np.ndarray) -> None:
        """Move and hurry the step that is being made for what the capture point (2,) is off its plan [m]."""
        step, scale = self.footsteps[self.made], self._scale
        stance = self._feet(terms)[1 - step.foot]
        self.began_s -= (hurry(step.foot, stance, error, scale) - 1.0) * (now - self._last_s)
        left_s = self.began_s + self.timing.single_s - now
        from_s = LATE_FROM_S * scale.time
        if left_s < -from_s:
            self._adjustment.late(self._planned(now)[1] - self._planned(now + left_s + from_s)[1])
        swing.move_target(self._adjustment.move(step, stance, error, left_s))

    def _feet(self, terms: DynamicsTerms) -> tuple[Footstep, ...]:
        """Both feet where they are, with the headings they were set down with."""
        return tuple(replace(foot, yaw_rad=self._yaws[foot.foot]) for foot in feet_now(self._robot, terms))
