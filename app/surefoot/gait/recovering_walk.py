"""A walk that makes emergency steps too, where it stands: before its start, at its end, and between two walks."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.emergency_step import STEP_HEIGHT_STIFFNESS, EmergencyStep, step_timing
from surefoot.gait.footsteps import Footstep, Pace, StepTiming, feet_now
from surefoot.gait.progress import Phase, Progress
from surefoot.gait.repeated_walk import RepeatedWalk
from surefoot.gait.step_adjustment import StepAdjustment
from surefoot.momentum.zmp import capture_point, natural_frequency
from surefoot.robot.description import RobotDescription
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference


class RecoveringWalk(RepeatedWalk):
    """Walks, and steps when the capture point leaves the soles that it stands on.

    Emergency steps are steps of the walk like others, but for their timing and their aim. What was still to be walked
    goes on from where they ended, as far and in the same direction, when the robot has stood for ``rest_s`` and the
    start has come. While it makes its planned steps, these are moved and hurried, and no others are made.

    Args:
        robot, posture, footsteps, timing, pace, walks, rest_s: as of a walk that is repeated.

    Attributes:
        recovery_steps: emergency steps that have landed.
        timing: as given; that of emergency steps while they are made.
    """

    def __init__(
        self,
        robot: RobotDescription,
        posture: TaskReference,
        footsteps: Sequence[Footstep],
        timing: StepTiming,
        *,
        pace: Pace,
        walks: int,
        rest_s: float,
    ) -> None:
        super().__init__(robot, posture, footsteps, timing, pace=pace, walks=walks, rest_s=rest_s)
        self.recovery_steps = 0
        self._emergency, self._recovers = EmergencyStep(robot), False
        self._as_walked = self.timing, self._feedback
        self._kept: tuple[Footstep, ...] = ()  # steps of the walk that wait for the emergency steps to end
        self._kept_from = np.zeros(2)  # between the feet when they were put aside
        self._steered: tuple[Pace, int] | None = None  # in their place, as told meanwhile: how, and how many

    @property
    def stances(self) -> tuple[int, ...]:
        """The feet that may stand while the other one makes an emergency step; none while none is made."""
        stands = self.phase in (Phase.WAITING, Phase.STANDING) or (self._recovers and self.phase is Phase.DOUBLE)
        return (0, 1) if stands else ()

    @property
    def steps_kept(self) -> int:
        """Planned steps that wait for emergency steps to end."""
        return self._steered[1] if self._steered else len(self._kept)

    @property
    def recovery_steps_planned(self) -> int:
        """Emergency steps that have landed or been decided."""
        return self.recovery_steps + (len(self.footsteps) - self.made if self._recovers else 0)

    @property
    def progress(self) -> Progress:
        """How far it has come, emergency steps among all others."""
        progress = super().progress
        return replace(progress, planned=progress.planned + self.steps_kept)

    def tick(self, terms: DynamicsTerms, sensing: FootSensing, held: TaskReference) -> TaskReference:
        """As of a walk, after an emergency step has been decided or aimed where one is needed."""
        now, com = terms.state.time_s, terms.position_com_in_world
        omega = natural_frequency(float(com[2]) - self._feedback.sole_height_m, self._robot.gravity)
        capture = capture_point(com, terms.velocity_com_in_world, omega)
        if self._recovers and self.phase is Phase.SINGLE:
            self._emergency.aim(self, now - self._last_s, terms, capture, omega)
        else:
            stance = self._emergency.stance_to_step_from(terms, self.stances, capture, omega)
            if stance is not None:
                self._begin(now, terms, stance)
            elif self._recovers and self.steps_ahead:
                self._emergency.follow_in_time(self, terms, capture, omega)
        made, reference = self.made, super().tick(terms, sensing, held)
        if self._recovers:
            self.recovery_steps += self.made - made
            if self.phase is Phase.STANDING:
                self._end()
        return reference

    def steer(self, pace: Pace, steps: int | None = None) -> None:
        """As of a walk; during emergency steps, and until it walks on after them, told for then."""
        if not (self._recovers or self.steps_kept):
            super().steer(pace, steps)
            return
        steps = self.steps_kept if steps is None else steps
        self.pace, self._steered = pace, (pace, steps) if steps else None

    def stop(self) -> None:
        """As of a walk; of emergency steps the last one sets the feet beside each other anyway."""
        if not (self._recovers or self.steps_kept):
            super().stop()
            return
        self.steps_again, self._kept, self._steered = 0, (), None

    def _walk_on(self, terms: DynamicsTerms) -> None:
        """What was put aside comes before the next walk; it needs the start to have come."""
        if not self.steps_kept:
            super()._walk_on(terms)
            return
        if terms.state.time_s < self.timing.start_s:
            return
        kept, steered = self._kept, self._steered
        self._kept, self._steered = (), None
        if steered:
            super().steer(*steered)
        else:
            way = self._between_feet(terms) - self._kept_from
            self.footsteps += tuple(replace(step, point=step.point + way) for step in kept)

    def _begin(self, now: float, terms: DynamicsTerms, stance: int) -> None:
        """Lift a foot at once; what was to be walked waits."""
        if not self._recovers:
            self._as_walked, self._recovers, self._adjusts = (self.timing, self._feedback), True, False
            self._feedback = self._feedback.with_others(stiffness=STEP_HEIGHT_STIFFNESS, reserve_m=0.0)
            self._adjustment = StepAdjustment(self._feedback.omega, self._scale)
            if len(self.footsteps) > self.made:
                self._kept, self._kept_from = self.footsteps[self.made :], self._between_feet(terms)
        self.timing = step_timing(self.timing.start_s, self._scale)
        self.footsteps = (*self.footsteps[: self.made], *self._emergency.steps_from(terms, stance))
        self._stands_since_s = None
        self.step_now(now, terms)

    def _end(self) -> None:
        """It stands again; from here it is led as a walk is."""
        self.timing, feedback = self._as_walked
        feedback.sole_height_m, feedback.lowered_m = self._feedback.sole_height_m, self._feedback.lowered_m
        self._feedback, self._recovers, self._adjusts = feedback, False, True

    def _between_feet(self, terms: DynamicsTerms) -> np.ndarray:
        left, right = feet_now(self._robot, terms)
        return 0.5 * (left.point + right.point)
