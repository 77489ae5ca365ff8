"""When the robot has fallen, why, and which limit went first."""

import math
from dataclasses import dataclass

import numpy as np

from surefoot.control.interface import ControlOutput
from surefoot.robot.description import BASE_DOFS, RobotDescription, RobotState
from surefoot.robot.feet import Support
from surefoot.robot.sizes import Sizes
from surefoot.simulation.measurement import BalanceMeasurement
from surefoot.simulation.plant import Plant

# Limits that define a fall. Height and forces are Bip's, other robots' in proportion (``robot.sizes``)
PELVIS_LOW_M = 0.65
TRUNK_TILT_RAD = np.deg2rad(40.0)
_TRUNK_UPRIGHT = math.cos(TRUNK_TILT_RAD)
SUPPORT_LOST_N = 50.0

# Limits that may go first on the way there
ZMP_EDGE_M = 0.001
SLIP_M = 0.01
FOOT_LOST_N = 5.0
RANGE_SLACK_RAD = 0.002
PERSISTENCE_TICKS = 5  # a limit must stay passed this long: single-tick contact noise is no event

NAN, CONTROLLER_ERROR, ESTIMATOR_ERROR = "nan", "controller_error", "estimator_error"
STOPPING = (NAN, CONTROLLER_ERROR, ESTIMATOR_ERROR)  # after these no step can be made
FALL_CAUSES = {  # what they mean: see ``fall_cause_text``
    "pelvis_low": "the base is below {pelvis_low_m:.3g} m",
    "trunk_tilt": "the trunk leans more than 40 degrees",
    NAN: "a number is no longer finite",
    CONTROLLER_ERROR: "the controller failed, its motors are switched off",
    ESTIMATOR_ERROR: "the estimator failed, the motors are switched off",
    "support_lost": "the swing foot carries more than {support_lost_n:.0f} N",
}
LIMITS = {
    "zmp_edge": "the measured ZMP is at the sole's edge",
    "qp_infeasible": "a QP has no solution",
    "torque": "a motor is at its torque limit",
    "joint_range": "a joint has left its range",
    "slip": "the stance foot has slipped",
    "foot_lost": "a stance foot has lost its load",
}


def fall_cause_text(name: str, sizes: Sizes) -> str:
    """What the cause of a fall means, with the numbers for a robot of that size."""
    return FALL_CAUSES[name].format(
        pelvis_low_m=PELVIS_LOW_M * sizes.base_height, support_lost_n=SUPPORT_LOST_N * sizes.weight
    )


def fall_cause(
    plant: Plant, state: RobotState, balance: BalanceMeasurement, support: Support, *, ground_m: float = 0.0
) -> str | None:
    """The named cause of a fall now, or None; ``ground_m`` is the height [m] that the pelvis' is counted from."""
    if not state.is_finite():
        return NAN
    sizes = plant.robot.sizes
    if float(state.q[2]) - ground_m < PELVIS_LOW_M * sizes.base_height:
        return "pelvis_low"
    if float(plant.link_rotation(plant.robot.trunk)[2, 2]) < _TRUNK_UPRIGHT:
        return "trunk_tilt"
    if support is not Support.DOUBLE:
        swing = 1 - support.reference_foot
        if balance.normal_forces[swing] > SUPPORT_LOST_N * sizes.weight:
            return "support_lost"
    return None


@dataclass(frozen=True)
class LimitEvent:
    """A limit that was passed, and when [s]."""

    name: str
    time_s: float


class LimitWatch:
    """Notes the first time that each limit is passed for five ticks on end (an infeasible QP: at once).

    A foot can slip or lose its load from its first contact on: a robot released above the ground has to land first.

    Args:
        robot: ranges and torque limits.
    """

    def __init__(self, robot: RobotDescription):
        self._robot = robot
        self._foot_lost_n = FOOT_LOST_N * robot.sizes.weight
        self._running: dict[str, int] = {}
        self._landed: set[int] = set()
        self._home: dict[int, tuple[float, float]] = {}
        self.events: list[LimitEvent] = []

    @property
    def first(self) -> LimitEvent | None:
        """The limit that went first."""
        return self.events[0] if self.events else None

    def update(
        self,
        time_s: float,
        state: RobotState,
        output: ControlOutput,
        applied: np.ndarray,
        plant: Plant,
        balance: BalanceMeasurement,
        standing: tuple[int, ...],
    ) -> tuple[LimitEvent, ...]:
        """Look at one tick; returns the limits passed for the first time.

        ``standing``: the feet that are to keep their load now, 0 left, 1 right.
        """
        joints = state.q[BASE_DOFS + 1 :]
        robot = self._robot
        for i in range(2):
            if i not in standing:  # it is being lifted
                self._landed.discard(i)
                self._home.pop(i, None)
            elif balance.normal_forces[i] >= self._foot_lost_n:
                self._landed.add(i)
        outside = float(np.maximum.reduce(np.maximum(joints - robot.joint_upper, robot.joint_lower - joints)))
        saturated = plant.physics.torque_limits and bool((np.abs(output.torques) > robot.torque_limits).any())
        passed = {
            "zmp_edge": balance.zmp_margin < ZMP_EDGE_M,
            "qp_infeasible": output.infeasible,
            "torque": saturated,
            "joint_range": outside > RANGE_SLACK_RAD,
            "slip": self._slipped(plant),
            "foot_lost": any(balance.normal_forces[i] < self._foot_lost_n for i in self._landed),
        }
        new = []
        for name, now in passed.items():
            if not now:
                self._running[name] = 0
                continue
            count = self._running[name] = self._running.get(name, 0) + 1
            needed = 1 if name == "qp_infeasible" else PERSISTENCE_TICKS
            if count == needed and all(event.name != name for event in self.events):
                event = LimitEvent(name, time_s - (needed - 1) * plant.model.opt.timestep)
                self.events.append(event)
                new.append(event)
        return tuple(new)

    def _slipped(self, plant: Plant) -> bool:
        feet = plant.feet()
        for i in self._landed:
            (x, y, _), height = feet[i].position_ankle.tolist(), self._robot.feet[i].ankle_height_m
            tilt_x, tilt_y = feet[i].rotation[:2, 2].tolist()
            here = x - height * tilt_x, y - height * tilt_y
            home = self._home.setdefault(i, here)
            if max(abs(here[0] - home[0]), abs(here[1] - home[1])) > SLIP_M:
                return True
        return False
