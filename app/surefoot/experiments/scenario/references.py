"""From a scenario to its reference: the posture it starts from, the swing with its plan, or the walk."""

import math
from dataclasses import replace

import numpy as np

from surefoot.control.balance_plan import BalancePlan, PlannedReference, plan_balance
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.reference_spec import AXES, EVEN_STEPS, FEET, ReferenceSpec, even_walk
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.gait.footsteps import Footstep, Pace, StepTiming, check_footsteps, plan_footsteps
from surefoot.gait.interface import Gait
from surefoot.gait.recovering_walk import RecoveringWalk
from surefoot.gait.repeated_walk import RepeatedWalk
from surefoot.gait.scale import gait_scale
from surefoot.gait.steering import footsteps_from
from surefoot.gait.step_when_needed import StepWhenNeeded
from surefoot.gait.walk import Walk
from surefoot.task.posture import standing_reference, walking_com_height
from surefoot.task.reference import Hold, Reference, Swing, TaskReference

_PLAN_STEP_S = 0.002
_PLAN_AROUND_S = 0.01


def start_posture(scenario: Scenario) -> TaskReference:
    """The standing posture a scenario starts from."""
    ground = scenario.ground.rotation_at(0.0) if scenario.ground.angle_at(0.0) else None
    robot, height = scenario.robot_description(), scenario.com_height_m
    if height is None and scenario.reference.kind == "walk":
        height = walking_com_height(robot)
    return standing_reference(robot, scenario.support, height, ground)


def level_stance_point(scenario: Scenario) -> tuple[float, float]:
    """The point (x, y) [m] below the stance ankle at t = 0, with the ground turned back to level: stones count from it.

    The left ankle in double support.
    """
    standing = standing_reference(scenario.robot_description(), scenario.support)
    ankle = standing.position_ankles[scenario.support.reference_foot]
    return float(ankle[0]), float(ankle[1])


def build_reference(scenario: Scenario, settings: ControllerSettings, dynamics: DynamicsModel) -> Reference:
    """The reference a scenario asks for; with its planned ZMP where the settings feed that forward.

    Raises:
        InvalidInput: the planned ZMP leaves the support polygon.
        PostureError: the swing cannot be reached.
    """
    reference = unplanned_reference(scenario.reference, start_posture(scenario))
    if scenario.reference.kind != "swing" or settings.feedforward != "planned":
        return reference
    plan = _plan_swing(dynamics, reference, scenario.reference)
    if plan.exit:
        reason = (
            f"the planned ZMP leaves the sole over the {plan.exit.edge} edge at {plan.exit.time_s:.3f} s, by "
            f"{1e3 * plan.exit.worst_m:.0f} mm at the worst; make the swing smaller or slower"
        )
        raise InvalidInput("reference.amplitude_m", scenario.reference.amplitude_m, reason)
    return PlannedReference(reference, plan)


def unplanned_reference(spec: ReferenceSpec, posture: TaskReference) -> Reference:
    """Hold or swing, starting from a posture; a walk's reference holds, its gait walks."""
    if spec.kind != "swing":
        return Hold(posture)
    return Swing(posture, AXES.index(spec.axis), spec.amplitude_m, spec.duration_s, spec.start_s)


def feet_at_start(scenario: Scenario) -> tuple[Footstep, Footstep]:
    """Both feet where they stand at the start, heading forward."""
    left, right = (
        Footstep(i, ankle[:2].copy(), 0.0) for i, ankle in enumerate(start_posture(scenario).position_ankles)
    )
    return left, right


def planned_footsteps(scenario: Scenario) -> list[Footstep]:
    """Where a scenario's walk is to step, each time that it walks; nowhere when it does not walk."""
    spec, feet = scenario.reference, feet_at_start(scenario)
    if spec.kind != "walk":
        return []
    if scenario.footsteps:
        middle = 0.5 * (feet[0].point + feet[1].point)
        return [
            Footstep(FEET.index(step.foot), middle + (step.x_m, step.y_m), math.radians(step.yaw_deg))
            for step in scenario.footsteps
        ]
    footsteps = plan_footsteps(
        feet,
        steps=spec.steps,
        length_m=spec.step_length_m,
        width_m=spec.step_width_m,
        turn_rad=math.radians(spec.turn_deg_per_step),
        first_foot=FEET.index(spec.first_foot),
    )
    for _ in range(spec.walks - 1):
        footsteps += footsteps_from(footsteps[-1], pace_of(spec), spec.steps)
    return footsteps


def even_steps(scenario: Scenario) -> ReferenceSpec:
    """``[reference]`` of a walk; where footsteps replace even steps, with those that the robot makes when steered."""
    sizes = even_walk(scenario.robot_description()) if scenario.footsteps else {}
    usual = {name: size for name, size in sizes.items() if name in EVEN_STEPS}
    return replace(scenario.reference, **usual)


def pace_of(spec: ReferenceSpec) -> Pace:
    """What its even steps are like."""
    turn = math.radians(spec.turn_deg_per_step)
    return Pace(length_m=spec.step_length_m, width_m=spec.step_width_m, turn_rad=turn)


def build_gait(scenario: Scenario) -> Gait | None:
    """The gait a scenario asks for; None where it asks for none. Raises InvalidInput: a foot cannot step there."""
    spec = scenario.reference
    if spec.kind != "walk":
        return StepWhenNeeded(scenario.robot_description(), start_posture(scenario)) if spec.step_when_needed else None
    footsteps = planned_footsteps(scenario)
    if scenario.footsteps:
        check_footsteps(feet_at_start(scenario), footsteps, gait_scale(scenario.robot_description()))
    timing = StepTiming(
        start_s=spec.start_s,
        period_s=spec.step_period_s,
        double_support_share=spec.double_support_share,
        lift_m=spec.lift_m,
    )
    robot, posture, pace = scenario.robot_description(), start_posture(scenario), pace_of(even_steps(scenario))
    if spec.walks == 1 and not spec.step_when_needed:
        return Walk(robot, posture, footsteps, timing, pace=pace)
    first = footsteps if spec.walks == 1 else footsteps[: spec.steps]
    kind = RecoveringWalk if spec.step_when_needed else RepeatedWalk
    return kind(robot, posture, first, timing, pace=pace, walks=spec.walks, rest_s=spec.rest_s)


def plan_scenario(scenario: Scenario) -> BalancePlan:
    """The plan of a scenario's swing. Raises InvalidInput when it has none, PostureError when out of reach."""
    if scenario.reference.kind != "swing":
        raise InvalidInput("reference.kind", scenario.reference.kind, "there is nothing to plan", ["swing"])
    dynamics = DynamicsModel(scenario.robot_description())
    reference = unplanned_reference(scenario.reference, start_posture(scenario))
    return _plan_swing(dynamics, reference, scenario.reference)


def _plan_swing(dynamics: DynamicsModel, reference: Reference, spec: ReferenceSpec) -> BalancePlan:
    """Every 2 ms from just before it starts to just after it ends."""
    steps = round((spec.duration_s + 2.0 * _PLAN_AROUND_S) / _PLAN_STEP_S) + 1
    return plan_balance(dynamics, reference, spec.start_s - _PLAN_AROUND_S + _PLAN_STEP_S * np.arange(steps))
