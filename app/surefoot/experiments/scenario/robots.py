"""Which robot a scenario means: one of ours by its name, or one of somebody else's by the path of its file."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.robot.description import RobotDescription, available_robots, load_robot, model_path
from surefoot.robot.model_files import files_sha256, mjcf_files
from surefoot.robot_import.robot_file import read_robot_file, robot_sha256

_KINDS = (".xml", ".urdf", ".xacro", ".toml")  # .xacro: to be told that it must be expanded first


def robot_named(name: str) -> RobotDescription:
    """The robot of that name, or of an MJCF, a URDF or a robot.toml. Raises InvalidInput."""
    if not is_robot_file(name):
        return load_robot(name)
    from surefoot.robot_import.load import load_robot_file  # MuJoCo, which readers of saved runs need not

    return load_robot_file(Path(name))


def sha256_now(name: str) -> str:
    """SHA-256 of the robot's files as they are now (``RobotDescription.sha256``). Raises InvalidInput."""
    if not is_robot_file(name):
        return files_sha256(mjcf_files(model_path(name)))
    return robot_sha256(read_robot_file(Path(name)))


def without_folder(table: Mapping[str, Any]) -> dict[str, Any]:
    """A scenario table that names its robot's file as a scenario file beside it would: a table may travel."""
    robot = table["robot"]
    return {**table, "robot": Path(robot).name if is_robot_file(robot) else robot}


def is_robot_file(name: object) -> bool:
    """Whether it is the path of a robot's file, by its suffix."""
    return isinstance(name, str) and Path(name).suffix in _KINDS


def check_robot(name: object, *, files: bool, folder: Path) -> str:
    """The name, or the whole path of a file.

    Args:
        name: as a scenario says it.
        files: whether it may be a file.
        folder: where its path starts, if it is not whole.

    Raises:
        InvalidInput: there is no such robot; lists those there are.
    """
    if isinstance(name, str) and name in available_robots():
        return name
    if files and is_robot_file(name):
        return str((folder / str(name)).resolve())
    choices = [*available_robots(), *(["path of an MJCF (.xml), a URDF (.urdf) or a robot.toml"] if files else [])]
    raise InvalidInput("robot", name, "no such robot", choices)
