"""The emergency step: a foot is set down where the capture point will be, when no ankle can bring it back any more."""

from dataclasses import replace

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.dcm_plan import NO_PLAN
from surefoot.gait.emergency_step import STEP_HEIGHT_STIFFNESS, EmergencyStep, step_timing
from surefoot.gait.footsteps import Footstep
from surefoot.gait.progress import Phase, Progress
from surefoot.gait.scale import gait_scale
from surefoot.gait.walk import Walk
from surefoot.momentum.zmp import capture_point, natural_frequency
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference


class StepWhenNeeded:
    """Holds what it is told to until the capture point leaves the soles; then steps, and stands there.

    The foot in the air steps; from two feet the one whose step leaves the capture point deeper in K_1. It lands where
    the capture point is expected, which is looked at again in every tick; the other foot follows, and is set down
    beside it or where the capture point needs it, until they are near enough to each other to stand so. Where that was
    not enough, the next step begins.

    Args:
        robot: the robot.
        posture: where it stands at the start.

    Attributes:
        made: steps that have landed.
    """

    def __init__(self, robot: RobotDescription, posture: TaskReference) -> None:
        self.made = 0
        self._robot, self._posture, self._steps = robot, posture, EmergencyStep(robot)
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
            self._steps.aim(walk, now - self._last_s, terms, capture, omega)
        else:
            stance = self._steps.stance_to_step_from(terms, self.stances, capture, omega)
            if stance is not None:
                walk = self._walk = self._begin(now, terms, stance)
            elif walk is not None and walk.steps_ahead:
                self._steps.follow_in_time(walk, terms, capture, omega)
        self._last_s = now
        if walk is None:
            return held
        made, reference = walk.made, walk.tick(terms, sensing, held)
        self.made += walk.made - made
        return reference

    def _begin(self, now: float, terms: DynamicsTerms, stance: int) -> Walk:
        height = float(self._posture.position_com[2])
        left, right = (foot.position_ankle_in_world.copy() for foot in terms.feet)
        posture = replace(
            self._posture,
            support=Support.DOUBLE,
            position_com=np.array((*terms.position_com_in_world[:2], height)),
            position_ankles=(left, right),
        )
        walk = Walk(
            self._robot,
            posture,
            self._steps.steps_from(terms, stance),
            step_timing(now, gait_scale(self._robot)),
            reserve_m=0.0,
            height_stiffness=STEP_HEIGHT_STIFFNESS,
            adjusts=False,
        )
        walk.step_now(now, terms)
        return walk
