"""Motors that are not perfect: slow to give a torque, weaker the faster they turn, with friction in their gears.

Coulomb and viscous friction are MuJoCo's own ``frictionloss`` and ``damping``. Its ``dcmotor`` takes a voltage and
wants resistance, inductance and torque constant, which nobody publishes of such a robot; what it comes to for one who
commands torques is the straight line from stall torque to no-load speed, which is here. MuJoCo has no backlash: a
second joint in series with a range of play would be needed, and other coordinates with it. There is none here.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from surefoot.field_metadata import check_fields, choice, preset_number, take_preset
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.simulation.physics import TIMESTEP_S
from surefoot.simulation.presets import CHEAP, LAB, PERFECT, PRESET_HELP, PRESETS, ROBOT

_PERFECT: dict[str, float] = dict.fromkeys(
    ("bandwidth_hz", "coulomb_share", "viscous_nms_rad", "no_load_speed_rad_s"), 0.0
)
# Chosen: no measurement of such a robot's drives was found. Gears of the harmonic kind lose a few percent of the rated
# torque; a torque loop of tens of hertz is what drives with a torque sensor are said to reach.
MOTOR_PRESETS: Mapping[str, Mapping[str, float]] = {
    PERFECT: _PERFECT,
    LAB: {**_PERFECT, "coulomb_share": 0.002, "viscous_nms_rad": 0.1},
    ROBOT: {**_PERFECT, "bandwidth_hz": 100.0, "coulomb_share": 0.01, "viscous_nms_rad": 0.5},
    CHEAP: {"bandwidth_hz": 40.0, "coulomb_share": 0.03, "viscous_nms_rad": 2.0, "no_load_speed_rad_s": 12.0},
}


@dataclass(frozen=True, kw_only=True)
class MotorSettings:
    """What the motors do other than asked; what is not said is as in the preset. Validated at creation (InvalidInput).

    Their saturation and delay are the plant's: ``physics.torque_limits``, ``physics.control_delay_s``.
    """

    preset: str = choice(PERFECT, PRESETS, PRESET_HELP)
    bandwidth_hz: float = preset_number(0.0, 1000.0, "Hz", "cutoff of the first-order torque loop; 0: at once")
    coulomb_share: float = preset_number(0.0, 0.2, "", "dry friction, as a part of each joint's torque limit")
    viscous_nms_rad: float = preset_number(0.0, 20.0, "N m s/rad", "viscous friction of each joint")
    no_load_speed_rad_s: float = preset_number(
        0.0, 100.0, "rad/s", "speed at which no torque is left, falling from the limit in a line; 0: none"
    )

    def __post_init__(self) -> None:
        """Take from the preset what is not said; refuse NaN, wrong types and values out of range."""
        take_preset(self, MOTOR_PRESETS, "motors")
        check_fields(self, "motors")


def add_friction(model: mujoco.MjModel, settings: MotorSettings, robot: RobotDescription) -> None:
    """Write the gears' friction into a compiled model, beside what the robot's file says of it."""
    if settings.coulomb_share > 0.0:
        model.dof_frictionloss[BASE_DOFS:] += settings.coulomb_share * robot.torque_limits
    if settings.viscous_nms_rad > 0.0:
        model.dof_damping[BASE_DOFS:] += settings.viscous_nms_rad


class Motors:
    """From the torques that are asked for to those that the motors give; it remembers the last.

    Args:
        settings: how good they are.
        limits: stall torques (n,) [N m].
    """

    def __init__(self, settings: MotorSettings, limits: np.ndarray):
        self._limits, self._no_load = limits, settings.no_load_speed_rad_s
        bandwidth = settings.bandwidth_hz
        self._share = 1.0 - math.exp(-2.0 * math.pi * bandwidth * TIMESTEP_S) if bandwidth > 0.0 else 1.0
        self._torques: np.ndarray | None = None

    def reset(self) -> None:
        """Forget the past: the first torques asked for are held already."""
        self._torques = None

    def give(self, asked: np.ndarray, speeds: np.ndarray) -> np.ndarray:
        """Torques (n,) [N m] of one millisecond, where (n,) [N m] are asked for at joint speeds (n,) [rad/s]."""
        torques = asked if self._torques is None else self._torques + self._share * (asked - self._torques)
        if self._no_load > 0.0:
            forward, backward = (self._limits * np.clip(1.0 - s * speeds / self._no_load, 0.0, 1.0) for s in (1, -1))
            torques = np.minimum(np.maximum(torques, -backward), forward)
        self._torques = torques
        return torques
