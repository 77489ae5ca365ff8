"""Which robot a scenario means: one of ours by its name, or one of somebody else's by the path of its file."""

from pathlib import Path

from surefoot.errors import InvalidInput
from surefoot.robot.description import RobotDescription, available_robots, load_robot

_KINDS = (".xml", ".toml")


def robot_named(name: str) -> RobotDescription:
    """The robot of that name, or of an MJCF or robot.toml. Raises InvalidInput."""
    if not is_robot_file(name):
        return load_robot(name)
    from surefoot.robot_import.load import load_robot_file  # MuJoCo, which readers of saved runs need not

    return load_robot_file(Path(name))


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
    choices = [*available_robots(), *(["path of an MJCF (.xml) or a robot.toml"] if files else [])]
    raise InvalidInput("robot", name, "no such robot", choices)
