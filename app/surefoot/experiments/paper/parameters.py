"""Every number of the report with its origin, read from the objects that carry it."""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from importlib import import_module
from typing import Any

import numpy as np

from surefoot.control.settings import ControllerSettings
from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import GAINS, LATCHED, SWING
from surefoot.experiments.paper.sources import constants
from surefoot.experiments.scenario.scenario import Scenario, load_scenario
from surefoot.robot.description import RobotDescription
from surefoot.simulation.physics import PhysicsSettings

PAPER, PUBLISHED, MEASURED, CHOSEN = "paper", "published model", "measured", "chosen"
ORIGINS = (PAPER, PUBLISHED, MEASURED, CHOSEN)
_FROM_PAPER = {"delta_ref_sagittal_nm", "delta_ref_frontal_nm"}  # "the reference value used ... was delta_P = 0"


@dataclass(frozen=True)
class Parameter:
    """One number.

    Attributes:
        group: the part of the table it stands in.
        name: as the program calls it.
        value: with its unit.
        meaning: one clause.
        origin: one of ``ORIGINS``.
    """

    group: str
    name: str
    value: str
    meaning: str
    origin: str


def parameters(f: Findings) -> list[Parameter]:
    """All of them, in the order of the table."""
    robot = load_scenario(SWING).robot_description()
    rows = [*_robot(robot), *_settings(ControllerSettings(), "controller"), *_settings(PhysicsSettings(), "plant")]
    for constant in constants():
        name = f"{constant.module.removeprefix('surefoot.')}.{constant.name}"
        value = _text(getattr(import_module(constant.module), constant.name), constant.unit)
        rows.append(Parameter(constant.group, name, value, constant.meaning, CHOSEN))
    rows += [
        Parameter(
            "gain sweep",
            gain.label,
            f"K_P {gain.stiffness:g} 1/s2, K_D {gain.damping:g} 1/s",
            "of the centre of mass, all three rows",
            CHOSEN,
        )
        for gain in GAINS
    ]
    for name in dict.fromkeys(case.scenario for case in f.plan.cases):
        rows += _scenario(load_scenario(name))
    rows += _measured(f)
    return rows


def joint_table(robot: RobotDescription) -> str:
    """Ranges, rotor inertias (published) and torque limits (chosen) of the joints, markdown."""
    lines = [
        "| joint | the paper's number | range [rad], published model | rotor [kg m2], published model | torque limit "
        "[N m], chosen |",
        "|---|---|---|---|---|",
    ]
    for joint in robot.joints:
        span = f"{joint.lower_rad:g} to {joint.upper_rad:g}"
        rotor, limit = joint.rotor_inertia_kgm2, joint.torque_limit_nm
        lines.append(f"| {joint.name} | {joint.number} | {span} | {rotor:g} | {limit:g} |")
    return "\n".join(lines)


def _robot(robot: RobotDescription) -> Iterator[Parameter]:
    def row(name: str, value: str, meaning: str, origin: str = PUBLISHED) -> Parameter:
        return Parameter("robot", name, value, meaning, origin)

    corners = ", ".join(f"({x:g}, {y:g})" for x, y in robot.feet[0].sole.vertices.tolist())
    yield row("m", f"{robot.mass_kg:g} kg", "total mass; the paper says 105 kg")
    yield row("g", f"{robot.gravity:g} m/s2", "gravity")
    yield row("h = |AP|", f"{robot.feet[0].ankle_height_m:g} m", "height of the ankle above the sole")
    yield row("sole", f"{corners} m", "corners about P, forward and to the left")
    yield row("degrees of freedom", str(len(robot.joints) + 6), "15 joints and the free pelvis", PAPER)


def _settings(settings: Any, group: str) -> Iterator[Parameter]:
    for field in fields(settings):
        meta = field.metadata
        if meta.get("kind") == "number":
            origin = PAPER if field.name in _FROM_PAPER else CHOSEN
            yield Parameter(group, field.name, _text(field.default, meta["unit"]), meta["help"], origin)


def _scenario(scenario: Scenario) -> Iterator[Parameter]:
    def row(name: str, value: str, meaning: str) -> Parameter:
        return Parameter("scenarios", name, value, meaning, CHOSEN)

    swing = scenario.reference
    if swing.kind == "swing":
        calibrated = scenario.name in ("paper_swing_35", "paper_swing_45")
        value = f"{swing.axis} {swing.amplitude_m:g} m in {swing.duration_s:g} s from {swing.start_s:g} s"
        yield row(scenario.name, value, "calibrated to infeasibility at 0.92 s" if calibrated else "swing")
    for stone in scenario.stones:
        size, place = f"{stone.size_m[0]:g} x {stone.size_m[1]:g} m", f"({stone.x_m:g}, {stone.y_m:g})"
        value = f"{stone.height_m:g} m high, {size} at {place}"
        yield row(scenario.name, value, f"stone, rises from {stone.rise_start_s:g} s in {stone.rise_duration_s:g} s")
    for push in scenario.pushes:
        value = f"{push.impulse_ns:g} N s in {push.duration_s:g} s towards {push.direction_deg:g} deg"
        yield row(scenario.name, value, f"push on {push.link} at {push.start_s:g} s")
    for key, value in scenario.controller.items():
        yield row(scenario.name, f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}", "setting")


def _measured(f: Findings) -> Iterator[Parameter]:
    summary = f.run(SWING, "optimization", LATCHED).summary
    since = summary["qp_infeasible_first_s"]
    if since is not None:
        yield Parameter(
            "measured",
            SWING,
            f"{since:.3f} s",
            "first infeasible tick of the hard QP; the paper's figure says about 0.92 s",
            MEASURED,
        )


def _text(value: Any, unit: str) -> str:
    if isinstance(value, tuple | list | np.ndarray):
        return f"({', '.join(f'{float(part):g}' for part in value)}) {unit}".strip()
    return f"{float(value):g} {unit}".strip()
