"""Which robot a picture is of, and how large: what the page scales its first values and its views with."""

import numpy as np

from surefoot.record import record
from surefoot.robot.description import RobotDescription, available_robots


@record
class ShownRobot:
    """A robot, for the page.

    Attributes:
        key: as a scenario says it: a name, or the path of a file.
        title: what people read: of a file the name of its MJCF or URDF.
        weight: its mass, as a ratio to Bip's: forces and impulses scale with it.
        leg: length of its legs, as a ratio to Bip's.
        sole: length of its sole, as a ratio to Bip's.
        width: of its sole, as a ratio to Bip's: a stone under the edge tilts a sole by its height over that.
        push: impulse that moves its capture point by the same share of the sole's width as one moves Bip's.
        sole_m: length and width of its sole.
        ahead_m: how far the middle of its sole lies ahead of the ankle.
        apart_m: between its ankles, standing on both feet.
    """

    key: str
    title: str
    weight: float
    leg: float
    sole: float
    width: float
    push: float
    sole_m: tuple[float, float]
    ahead_m: float
    apart_m: float

    @property
    def moment(self) -> float:
        """Moments about its ankles, as a ratio to Bip's: its weight at a sole's length."""
        return self.weight * self.sole


FIRST_ROBOT = "bip"  # on which scenarios and tour were tried out


def shown_robot(key: str, robot: RobotDescription) -> ShownRobot:
    """What the page needs of a robot that a scenario calls ``key``."""
    sizes, corners = robot.sizes, robot.feet[0].sole.vertices
    length_m, width_m = (round(float(np.ptp(across)), 4) for across in corners.T)
    return ShownRobot(
        key=key,
        title=robot_title(robot.name),
        weight=sizes.weight,
        leg=sizes.leg,
        sole=sizes.sole_length,
        width=sizes.sole_width,
        push=sizes.weight * sizes.sole_width / sizes.com_height**0.5,  # J = m omega d, omega = sqrt(g / h)
        sole_m=(length_m, width_m),
        ahead_m=round(robot.feet[0].sole_middle_m, 4),
        apart_m=2.0 * sizes.foot_spread_m,
    )


def view_scale(robot: RobotDescription) -> float:
    """How large it is to be looked at, as a ratio to Bip: the mean of those of the heights of CoM and base."""
    return 0.5 * (robot.sizes.com_height + robot.sizes.base_height)


def robot_choices(shown: ShownRobot) -> dict[str, str]:
    """Title -> key of the robots there are, and of the one that is shown if it is none of these."""
    choices = {robot_title(name): name for name in available_robots()}
    if shown.key not in choices.values():
        choices[f"{shown.title} (file)" if shown.title in choices else shown.title] = shown.key
    return choices


def robot_title(name: str) -> str:
    """The name of a robot for people: with a capital."""
    return name[:1].upper() + name[1:]
