"""A robot of one's own from its file."""

from functools import lru_cache
from pathlib import Path

from surefoot.errors import InvalidInput
from surefoot.robot.description import RobotDescription
from surefoot.robot_import.describe import describe
from surefoot.robot_import.inspection import inspect_robot
from surefoot.robot_import.stances import with_stances


def load_robot_file(path: Path) -> RobotDescription:
    """Read an MJCF, a URDF or a robot.toml. What gravity asks too much of may run: it may stand on two feet.

    Raises:
        InvalidInput: the file cannot be read, or something is in the way: says what, and what helps.
    """
    return _load(path.resolve())


@lru_cache(maxsize=4)
def _load(path: Path) -> RobotDescription:
    inspection = inspect_robot(path)
    if inspection.problems or inspection.robot is None:
        problem = inspection.problems[0]
        more = f"; see surefoot robot check {path}"
        raise InvalidInput("robot", str(path), f"{problem.reason}: {problem.remedy}{more}")
    return with_stances(describe(inspection.robot), inspection.robot.said)[0]
