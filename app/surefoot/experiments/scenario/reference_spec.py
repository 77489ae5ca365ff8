"""``[reference]`` and ``[[footsteps]]`` of a scenario: what the robot should do."""

import math
from dataclasses import dataclass
from typing import Any

from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.field_metadata import check_fields, choice, count, number, range_of, switch
from surefoot.gait.footsteps import NARROWEST_M
from surefoot.gait.scale import gait_scale
from surefoot.robot.description import RobotDescription

AXES = ("sagittal", "lateral")
FEET = ("left", "right")
# Who steps is stiffer than who stands, and makes the step though a joint meets its stop: the settings where the
# scenario says nothing else. Found by trial, Bip walking on flat ground; the ranges with a 20 mm stone under each step.
WALKING_GAINS = {
    "foot_stiffness": 400.0,
    "foot_damping": 40.0,
    "foot_weight": 10.0,
    "pelvis_stiffness": 100.0,
    "pelvis_damping": 20.0,
    "pelvis_weight": 2.0,
    "lumbar_stiffness": 100.0,
    "lumbar_damping": 20.0,
    "joint_ranges": False,
}
MOST_STEPS = 2000
EVEN_STEPS = ("steps", "step_length_m", "step_width_m", "turn_deg_per_step", "first_foot", "walks")  # footsteps replace


def walking_gains(robot: RobotDescription) -> dict[str, Any]:
    """``WALKING_GAINS`` of a robot, its stiffnesses and damping in proportion to its natural frequency.

    No stiffness is above what a controller takes; the damping goes with what it then is.
    """
    gains = dict(WALKING_GAINS)
    for what in ("foot", "pelvis", "lumbar"):
        stiffness, damping = f"{what}_stiffness", f"{what}_damping"
        ratio = min(gait_scale(robot).stiffness, range_of(ControllerSettings, stiffness)[1] / WALKING_GAINS[stiffness])
        gains[stiffness], gains[damping] = ratio * gains[stiffness], math.sqrt(ratio) * gains[damping]
    return gains


def even_walk(robot: RobotDescription) -> dict[str, float]:
    """Length, width, period and lift of a walk's steps where a scenario says nothing: Bip's in proportion."""
    scale = gait_scale(robot)
    ratios = {"step_length_m": scale.length, "step_width_m": scale.width, "step_period_s": scale.time}
    ratios["lift_m"] = scale.length
    return {name: round(ratio * getattr(ReferenceSpec, name), 4) for name, ratio in ratios.items()}


@dataclass(frozen=True, kw_only=True)
class ReferenceSpec:
    """``[reference]``: hold the posture, swing the CoM from rest to rest along one axis, or walk."""

    kind: str = choice("hold", ("hold", "swing", "walk"), "what the robot should do")
    axis: str = choice("lateral", AXES, "lateral (positive = left) or sagittal (positive = forward)")
    amplitude_m: float = number(0.0, -0.3, 0.3, "m", "displacement of the CoM", step=0.005)
    duration_s: float = number(0.5, 0.02, 20.0, "s", "time from rest to rest", step=0.05)
    start_s: float = number(0.2, 0.0, 600.0, "s", "when it starts", step=0.1)
    steps: int = count(10, 1, MOST_STEPS, "walk: how many steps, the last of which sets the feet beside each other")
    step_length_m: float = number(
        0.2, -0.3, 0.5, "m", "walk: how far a step is ahead of the other foot", step=0.01, goes_with="leg"
    )
    step_width_m: float = number(
        0.22, NARROWEST_M, 0.4, "m", "walk: between the feet", step=0.01, goes_with="foot_spread"
    )
    step_period_s: float = number(
        0.8, 0.3, 3.0, "s", "walk: from touch-down to touch-down", step=0.05, goes_with="time"
    )
    double_support_share: float = number(0.2, 0.05, 0.6, "", "walk: part of each step on two feet", step=0.01)
    lift_m: float = number(0.05, 0.01, 0.15, "m", "walk: how high a foot is lifted", step=0.005, goes_with="leg")
    turn_deg_per_step: float = number(
        0.0, -20.0, 20.0, "deg", "walk: heading gained in each step, to the left", step=1.0
    )
    first_foot: str = choice("left", FEET, "walk: which foot steps first")
    walks: int = count(1, 1, 100, "walk: how many times it walks so, and stands in between")
    rest_s: float = number(0.5, 0.0, 60.0, "s", "walk: how long it stands before it walks again", step=0.1)
    step_when_needed: bool = switch(
        False, "step when the capture point leaves the soles; walk: before its start, at its end and in between"
    )

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "reference")
        if self.kind == "walk" and self.walks * self.steps > MOST_STEPS:
            reason = f"makes more than {MOST_STEPS} steps with reference.steps = {self.steps}"
            raise InvalidInput("reference.walks", self.walks, reason, [f"up to {MOST_STEPS // self.steps}"])

    @property
    def steps_at_all(self) -> bool:
        """Whether feet may be lifted."""
        return self.kind == "walk" or self.step_when_needed


@dataclass(frozen=True, kw_only=True)
class FootstepSpec:
    """``[[footsteps]]``: one step of a walk, in place of even ones.

    Attributes:
        foot: which steps.
        x_m, y_m: where, the point below its ankle, from the middle between the feet at the start: forward, left.
        yaw_deg: its heading there, positive to the left.
    """

    foot: str = choice("left", FEET, "which foot steps")
    x_m: float = number(0.0, -50.0, 50.0, "m", "where to, forward of the start", step=0.05)
    y_m: float = number(0.0, -50.0, 50.0, "m", "where to, to the left of the start", step=0.01)
    yaw_deg: float = number(0.0, -360.0, 360.0, "deg", "heading of the foot there, to the left", step=5.0)

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "footsteps")
