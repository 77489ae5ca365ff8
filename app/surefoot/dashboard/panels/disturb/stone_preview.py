"""Where the next stone would come up."""

from dataclasses import replace

from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.messages.sole_places import SOLE_PLACES, place_on_sole
from surefoot.dashboard.messages.stone_view import StoneView, preview_of
from surefoot.dashboard.panels.disturb.stones import NOWHERE
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.simulation.stones import Stone


def aimed_stone(where: str, stone: Stone | None, snapshot: Snapshot, robot: RobotDescription) -> StoneView | None:
    """What is to be shown of a stone that is not there yet; None when it should not be shown.

    Args:
        where: a place of the sole, or a word of the panel.
        stone: what it is like, and its place when that is a point of its own; None: no such stone.
        snapshot: how things stand.
        robot: whose soles.
    """
    if where == NOWHERE or stone is None:
        return None
    geometry = snapshot.geometry
    if where in SOLE_PLACES:
        index = Support(snapshot.support).reference_foot
        x, y, _ = place_on_sole(robot.feet[index], geometry.soles[index], where).tolist()
        stone = replace(stone, x_m=x, y_m=y)
    return preview_of(stone, geometry.ground_rotation, geometry.ground_pivot)
