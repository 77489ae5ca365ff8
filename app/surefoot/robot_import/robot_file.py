"""``robot.toml``: what a person says of a robot beside its MJCF file or URDF. All but ``mjcf`` may be left out."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot.feet import Side
from surefoot.robot.model_files import files_sha256, model_files
from surefoot.robot_import.base_frame import BaseAxes
from surefoot.text_files import file_content, text_of, toml_of

_KEYS = ("mjcf", "keyframe", "trunk", "frozen", "base", "posture", "feet", "torque_limits")
_FOOT_KEYS = ("body", "ankle_joints", "corners")


@record
class FootFile:
    """What is said of one foot.

    Attributes:
        body: name of the foot's body.
        ankle_joints: names of its pitch and roll joint, in this order.
        corners: (n, 3) corners of the sole in the frame of that body [m].
    """

    body: str | None = None
    ankle_joints: tuple[str, str] | None = None
    corners: np.ndarray | None = None


@record
class RobotFile:
    """What is said of a robot; None or empty is found out from the MJCF.

    Attributes:
        mjcf: path of the MJCF file or the URDF.
        path: of the robot.toml, None where there is none.
        keyframe: name of the keyframe of the MJCF to stand in.
        trunk: body that must stay up.
        frozen: joints that are taken out, each held at its angle in the posture.
        posture_rad: joint name -> angle, on top of the keyframe.
        feet: side -> what is said of that foot.
        torque_limits_nm: joint name -> largest torque, before that of the MJCF.
        base_axes: how the base's frame lies in the MJCF; None: x forward, z up.
    """

    mjcf: Path
    path: Path | None
    keyframe: str | None
    trunk: str | None
    frozen: tuple[str, ...]
    posture_rad: Mapping[str, float]
    feet: Mapping[Side, FootFile]
    torque_limits_nm: Mapping[str, float]
    base_axes: BaseAxes | None = None


def read_robot_file(path: Path) -> RobotFile:
    """Read a robot.toml; an MJCF or a URDF (any other suffix than .toml) says nothing but itself.

    Raises:
        InvalidInput: it cannot be read, or says something that is not understood; lists what could be said.
    """
    if path.suffix != ".toml":
        return RobotFile(path, None, None, None, (), {}, {side: FootFile() for side in Side}, {})
    table = toml_of(text_of(file_content(path, "robot"), "robot", str(path)), "robot", str(path), valid=_KEYS)
    _check_keys(table, "", _KEYS)
    if "mjcf" not in table:
        raise InvalidInput(
            "mjcf", None, f"{path} must say which MJCF file or URDF it describes, e.g. mjcf = 'robot.xml'"
        )
    feet = _table(table, "feet")
    _check_keys(feet, "feet.", [str(side) for side in Side])
    return RobotFile(
        mjcf=path.parent / _text(table, "mjcf"),
        path=path,
        keyframe=_text(table, "keyframe") if "keyframe" in table else None,
        trunk=_text(table, "trunk") if "trunk" in table else None,
        frozen=_names(table.get("frozen", []), "frozen"),
        posture_rad=_numbers(_table(table, "posture"), "posture"),
        feet={side: _foot(_table(feet, side, "feet."), f"feet.{side}.") for side in Side},
        torque_limits_nm=_positive(_numbers(_table(table, "torque_limits"), "torque_limits")),
        base_axes=_base_axes(table),
    )


def robot_sha256(file: RobotFile) -> str:
    """SHA-256 of all that decides the robot: its robot.toml, and the files of its model (``robot.model_files``)."""
    files = model_files(file.mjcf)
    return files_sha256(files if file.path is None else {"robot.toml": file.path, **files})


def _base_axes(file: Mapping[str, Any]) -> BaseAxes | None:
    if "base" not in file:
        return None
    table = _table(file, "base")
    _check_keys(table, "base.", ("forward", "up"))
    return BaseAxes(*(_text({"forward": "x", "up": "z"} | dict(table), key, "base.") for key in ("forward", "up")))


def _foot(table: Mapping[str, Any], where: str) -> FootFile:
    _check_keys(table, where, _FOOT_KEYS)
    joints = _names(table["ankle_joints"], f"{where}ankle_joints") if "ankle_joints" in table else None
    if joints is not None and len(joints) != 2:
        raise InvalidInput(f"{where}ankle_joints", list(joints), "must be two joints: the pitch joint, the roll joint")
    return FootFile(
        body=_text(table, "body", where) if "body" in table else None,
        ankle_joints=None if joints is None else (joints[0], joints[1]),
        corners=_corners(table["corners"], f"{where}corners") if "corners" in table else None,
    )


def _corners(value: Any, field: str) -> np.ndarray:
    rows = value if isinstance(value, list) else []
    if len(rows) < 3 or not all(
        isinstance(row, list) and len(row) == 3 and all(_is_number(number) for number in row) for row in rows
    ):
        raise InvalidInput(field, value, "must be three or more points [x, y, z] in the frame of the foot's body, in m")
    return np.array(rows, dtype=float)


def _check_keys(table: Mapping[str, Any], where: str, valid: tuple[str, ...] | list[str]) -> None:
    for key in table:
        if key not in valid:
            raise InvalidInput(f"{where}{key}", table[key], "no such key", valid)


def _table(table: Mapping[str, Any], key: str, where: str = "") -> Mapping[str, Any]:
    value = table.get(key, {})
    if not isinstance(value, dict):
        raise InvalidInput(f"{where}{key}", value, f"must be a table, e.g. [{where}{key}]")
    return value


def _text(table: Mapping[str, Any], key: str, where: str = "") -> str:
    if not isinstance(table[key], str) or not table[key]:
        raise InvalidInput(f"{where}{key}", table[key], "must be a text in quotes")
    return table[key]


def _names(value: Any, field: str) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
        raise InvalidInput(field, value, 'must be a list of joint names, e.g. ["neck_yaw"]')
    return tuple(value)


def _numbers(table: Mapping[str, Any], where: str) -> dict[str, float]:
    for key, value in table.items():
        if not _is_number(value):
            raise InvalidInput(f"{where}.{key}", value, "must be a number")
    return {key: float(value) for key, value in table.items()}


def _positive(limits: dict[str, float]) -> dict[str, float]:
    for key, value in limits.items():
        if value <= 0.0:
            raise InvalidInput(f"torque_limits.{key}", value, "must be more than 0 N m")
    return limits


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
