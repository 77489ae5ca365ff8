"""A plant that is not the robot its controller knows: every link a little heavier, longer, or elsewhere.

Errors are uniform between minus and plus what is set, drawn from the seed; the controller keeps the nominal robot.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from surefoot.field_metadata import check_fields, choice, count, preset_number, take_preset
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Foot
from surefoot.simulation.presets import CHEAP, LAB, MOST_SEEDS, PERFECT, PRESET_HELP, PRESETS, ROBOT

_PERFECT: dict[str, float] = dict.fromkeys(("mass", "inertia", "com_m", "length", "sole_m", "friction"), 0.0)
# Masses to +-10 % and friction from 0.4 to 1.0, which is +-43 % of its middle, are what MuJoCo Playground spreads its
# G1 by; the other figures are chosen, between a model from CAD and one that was measured.
MODEL_ERROR_PRESETS: Mapping[str, Mapping[str, float]] = {
    PERFECT: _PERFECT,
    LAB: {"mass": 0.01, "inertia": 0.02, "com_m": 0.001, "length": 0.0005, "sole_m": 0.0005, "friction": 0.05},
    ROBOT: {"mass": 0.03, "inertia": 0.1, "com_m": 0.004, "length": 0.002, "sole_m": 0.001, "friction": 0.2},
    CHEAP: {"mass": 0.1, "inertia": 0.2, "com_m": 0.01, "length": 0.005, "sole_m": 0.003, "friction": 0.43},
}


@dataclass(frozen=True, kw_only=True)
class ModelErrorSettings:
    """How far the plant may be from the nominal robot; what is not said is as in the preset. Raises InvalidInput."""

    preset: str = choice(PERFECT, PRESETS, PRESET_HELP)
    seed: int = count(0, 0, MOST_SEEDS, "of all these errors")
    mass: float = preset_number(0.0, 0.3, "", "of each link's mass, and with it its inertia, as a part of it")
    inertia: float = preset_number(0.0, 0.5, "", "of each link's inertia about its centre of mass, as a part of it")
    com_m: float = preset_number(0.0, 0.05, "m", "of each link's centre of mass, each axis")
    length: float = preset_number(0.0, 0.02, "", "of each link's length from joint to joint, as a part of it")
    sole_m: float = preset_number(0.0, 0.01, "m", "of each sole's place below its ankle, each axis")
    friction: float = preset_number(0.0, 0.9, "", "of the friction of all ground, as a part of it")

    def __post_init__(self) -> None:
        """Take from the preset what is not said; refuse NaN, wrong types and values out of range."""
        take_preset(self, MODEL_ERROR_PRESETS, "model_error")
        check_fields(self, "model_error")

    @property
    def any(self) -> bool:
        """Whether anything but friction differs."""
        return any((self.mass, self.inertia, self.com_m, self.length, self.sole_m))

    @property
    def friction_scale(self) -> float:
        """What the coefficient of friction is multiplied by."""
        return 1.0 + self.friction * float(self._stream(6).uniform(-1.0, 1.0))

    def _stream(self, number: int) -> np.random.Generator:
        """A stream of its own for each quantity: two runs that differ in one share the errors of all others."""
        return np.random.default_rng((self.seed, number))

    def draw(self, links: int) -> dict[str, np.ndarray]:
        """Errors by quantity: (links,) or (links, 3); of the soles (2, 3)."""
        shapes = {"mass": links, "inertia": links, "com_m": (links, 3), "length": links, "sole_m": (2, 3)}
        return {
            name: getattr(self, name) * self._stream(i).uniform(-1.0, 1.0, shape)
            for i, (name, shape) in enumerate(shapes.items(), 1)
        }


def perturb(spec: mujoco.MjSpec, robot: RobotDescription, settings: ModelErrorSettings) -> None:
    """Write the errors into a robot's model before it is compiled, so that MuJoCo works out all that follows.

    Args:
        spec: the robot's model, as its file has it.
        robot: which robot it is.
        settings: how large the errors are.
    """
    model = spec.compile()
    links = [body for body in spec.bodies if body.name and model.body(body.name).rootid[0] == _root(model, robot)]
    errors = settings.draw(len(links))
    for i, body in enumerate(links):
        nominal = model.body(body.name)
        mass = 1.0 + errors["mass"][i]
        body.explicitinertial = True
        body.fullinertia = np.full(6, np.nan)
        body.mass = float(nominal.mass[0]) * mass
        body.inertia = _possible(nominal.inertia * mass * (1.0 + errors["inertia"][i]))
        body.ipos, body.iquat = nominal.ipos + errors["com_m"][i], nominal.iquat
        if body.name != robot.base:
            body.pos = nominal.pos * (1.0 + errors["length"][i])
    for foot, shift in zip(robot.feet, errors["sole_m"], strict=True):
        for geom in spec.body(foot.body).geoms:
            if geom.contype or geom.conaffinity:
                geom.pos = geom.pos + shift


def as_built(robot: RobotDescription, settings: ModelErrorSettings) -> RobotDescription:
    """The robot with its soles where they really are, for metrics and views; the same object without such errors."""
    if settings.sole_m == 0.0:
        return robot
    shifts = settings.draw(0)["sole_m"]
    left, right = (_shifted(foot, foot.rotation_in_body.T.dot(d)) for foot, d in zip(robot.feet, shifts, strict=True))
    return replace(robot, feet=(left, right))


def _shifted(foot: Foot, shift: np.ndarray) -> Foot:
    """A foot whose sole lies elsewhere by (3,) [m], foot axes."""
    return replace(
        foot,
        ankle_height_m=foot.ankle_height_m - float(shift[2]),
        sole=foot.sole.moved(np.eye(2), shift[:2]),
        corners_from_ankle=foot.corners_from_ankle + shift,
    )


def _possible(inertia: np.ndarray) -> np.ndarray:
    """Principal inertias (3,), none above the sum of the others: rounding lifts those of a flat plate above it."""
    largest = int(np.argmax(inertia))
    inertia[largest] = min(inertia[largest], np.delete(inertia, largest).sum())
    return inertia


def _root(model: mujoco.MjModel, robot: RobotDescription) -> int:
    return int(model.body(robot.base).rootid[0])
