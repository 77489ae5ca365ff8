"""Which robot a picture is of, and how large: what the page scales its first values and its views with."""

from pathlib import Path

from surefoot.record import record
from surefoot.robot.description import RobotDescription


@record
class ShownRobot:
    """A robot, for the page.

    Attributes:
        key: as a scenario says it: a name, or the path of a file.
        title: what people read.
        weight: its mass, as a ratio to Bip's: forces and impulses scale with it.
        height: of its centre of mass, standing, as a ratio to Bip's.
        sole: length of its sole, as a ratio to Bip's.
    """

    key: str
    title: str
    weight: float
    height: float
    sole: float


_SOLE_M = 0.29  # Bip's, from heel to toe


def shown_robot(key: str, robot: RobotDescription) -> ShownRobot:
    """What the page needs of a robot that a scenario calls ``key``."""
    x = robot.feet[0].sole.vertices[:, 0]
    return ShownRobot(
        key=key,
        title=robot_title(key),
        weight=robot.sizes.weight,
        height=robot.sizes.com_height,
        sole=round(float(x.max() - x.min()), 4) / _SOLE_M,
    )


def robot_title(key: str) -> str:
    """The name of a robot for people: of a file its own, of a ``robot.toml`` its folder's."""
    path = Path(key)
    name = path.parent.name if path.name == "robot.toml" else path.stem
    return name[:1].upper() + name[1:]
