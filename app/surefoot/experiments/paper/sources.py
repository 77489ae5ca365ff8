"""Where the constants of the program stand: found in its sources, with a meaning where no comment gives one."""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import surefoot

FOLDERS = ("task", "momentum", "control", "simulation")
_PACKAGE = Path(surefoot.__file__).parent
_GROUPS = {"task": "posture", "momentum": "momentum", "control": "limits and QP", "simulation": "plant and falls"}
_BOOKKEEPING = {"BASE_DOFS"}


@dataclass(frozen=True)
class Constant:
    """A number that is no setting.

    Attributes:
        module, name: where it stands.
        unit: of its value.
        meaning: one clause; empty when neither the table below nor a comment beside it says.
        group: part of the parameter table.
    """

    module: str
    name: str
    unit: str
    meaning: str
    group: str


# name: unit, meaning. What is not here is described by the comment beside it in the source.
_DESCRIBED = {
    "DEFAULT_COM_HEIGHT": ("m", "height of G, so that every joint is in range"),
    "_SWING_INWARD": ("m", "the swing ankle is this much closer in"),
    "_SWING_LIFT": ("m", "the swing foot is lifted"),
    "_COM_FORWARD": ("", "G ahead of the ankles, of the way to the middle of the sole"),
    "_PELVIS_ROLL": ("rad", "the pelvis drops on the swing side"),
    "GUARD_SCALE": ("", "of the sole: where the capture point meets the guard"),
    "GUARD_SLOPE": ("", "how soon before that edge the ZMP must move ahead of the capture point"),
    "GUARD_INSET_M": ("m", "the guard asks for no more than this inside the margin"),
    "GATE_ROLL_RAD": ("rad", "a sole rolled by more stands on a stone"),
    "GATE_CORNER_SCALE": ("", "of the sole, while the gate is on: virtual contact corners"),
    "_FORCE_WEIGHT": ("", "of squared corner forces [body weights] against squared kappa''"),
    "_RANGE_HORIZON_S": ("s", "a joint may use up its distance to the stop in this time"),
    "_RANGE_BRAKE": ("rad/s2", "the most that a joint range asks for"),
    "_RANGE_NEAR": ("rad/s2", "a range further away than this gets no row"),
    "_LOADED_AT": ("", "share of the weight from which a foot counts as fully loaded (double support)"),
    "BLEND_TICKS": ("ticks", "a live switch of controllers fades over these"),
    "_RESOLUTION_NM": ("N m", "how finely the admissible interval of delta_ref is bisected"),
    "SMOOTH": ("rad/s", "joint friction fed forward: rate at which three quarters of the dry friction are given"),
    "STICKS": ("rad/s", "joint friction fed forward: below about this a joint counts as sticking"),
    "TIMESTEP_S": ("s", "step of simulation and control"),
    "CONTACT_SOLREF": ("s, -", "time constant and damping ratio of a contact"),
    "IMPEDANCE_RATIO": ("", "friction against normal force in a contact"),
    "POOL_SIZE": ("", "stones at most"),
    "_ROOT_M": ("m", "how far a stone reaches into the ground"),
    "_PARKED_M": ("m", "height where unused stones wait"),
    "_DROP_FROM_M": ("m", "dropped stones fall from here"),
    "_GRAVITY": ("m/s2", "of dropped stones"),
    "PELVIS_LOW_M": ("m", "a fall: the pelvis is lower"),
    "TRUNK_TILT_RAD": ("rad", "a fall: the trunk leans more"),
    "SUPPORT_LOST_N": ("N", "a fall in single support: the swing foot carries more"),
    "ZMP_EDGE_M": ("m", "a limit: the ZMP is closer to the edge"),
    "SLIP_M": ("m", "a limit: the stance foot has slipped further"),
    "FOOT_LOST_N": ("N", "a limit: a stance foot carries less"),
    "RANGE_SLACK_RAD": ("rad", "a limit: a joint is further outside its range"),
    "PERSISTENCE_TICKS": ("ticks", "a limit must stay passed this long"),
    "_LOADED_N": ("N", "a foot that carries less has no centre of pressure"),
    "_ABSURD_TORQUE_NM": ("N m", "torques beyond this are treated like a NaN"),
}
_UNITS = {"M": "m", "S": "s", "N": "N", "NM": "N m", "RAD": "rad", "TICKS": "ticks", "KG": "kg", "MPS": "m/s"}


def constants() -> Iterator[Constant]:
    """Every name in capitals that a module of the four folders binds to a number or a tuple of numbers."""
    for folder in FOLDERS:
        for path in sorted((_PACKAGE / folder).rglob("*.py")):
            module = ".".join(path.relative_to(_PACKAGE.parent).with_suffix("").parts)
            source = path.read_text(encoding="utf-8")
            for name, comment in _found(source):
                unit, meaning = _DESCRIBED.get(name, (_UNITS.get(name.rsplit("_", 1)[-1], ""), comment))
                yield Constant(module, name, unit, meaning, _GROUPS[folder])


def _found(source: str) -> Iterator[tuple[str, str]]:
    lines = source.splitlines()
    for node in ast.parse(source).body:
        if not isinstance(node, ast.Assign) or not _is_number(node.value):
            continue
        comment = lines[(node.end_lineno or node.lineno) - 1].partition("#")[2].strip()
        for target in node.targets:
            names = target.elts if isinstance(target, ast.Tuple) else [target]
            for name in names:
                if isinstance(name, ast.Name) and name.id.isupper() and name.id not in _BOOKKEEPING:
                    yield name.id, comment


def _is_number(node: ast.expr) -> bool:
    if isinstance(node, ast.UnaryOp):
        return _is_number(node.operand)
    if isinstance(node, ast.BinOp):
        return _is_number(node.left) and _is_number(node.right)
    if isinstance(node, ast.Tuple):
        return bool(node.elts) and all(_is_number(part) for part in node.elts)
    if isinstance(node, ast.Call):
        return getattr(node.func, "attr", "") in ("deg2rad", "radians")
    return isinstance(node, ast.Constant) and isinstance(node.value, int | float) and not isinstance(node.value, bool)
