"""Which two bodies are the feet: those that robot.toml names, else the two lowest ends of chains, one on each side."""

from collections.abc import Mapping

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot.feet import Side
from surefoot.robot_import.foot_points import lowest_height
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.problem import RefusedError
from surefoot.robot_import.robot_file import FootFile

_FEWEST_HINGES = 3
_MIRRORED_M = 0.02  # how far the two ends may lie from being each other's mirror image


@record
class FootBody:
    """A foot's body.

    Attributes:
        side: left (to the base's +y) or right.
        body: its index.
        how: how it was found, for the report.
    """

    side: Side
    body: int
    how: str


def find_feet(tree: KinematicTree, said: Mapping[Side, FootFile]) -> tuple[FootBody, FootBody]:
    """The left foot and the right foot.

    Args:
        tree: the robot in its posture.
        said: what robot.toml says of the feet.

    Raises:
        InvalidInput: robot.toml names a body that is not there.
        RefusedError: there are no two mirrored ends of chains.
    """
    named = {side: _named(tree, side, foot.body) for side, foot in said.items() if foot.body is not None}
    if len(named) == 2:
        return named[Side.LEFT], named[Side.RIGHT]
    left, right = _lowest_pair(tree)
    return named.get(Side.LEFT, left), named.get(Side.RIGHT, right)


def _named(tree: KinematicTree, side: Side, name: str) -> FootBody:
    names = [tree.body_name(body) for body in range(1, tree.model.nbody)]
    if name not in names:
        raise InvalidInput(f"feet.{side}.body", name, "the MJCF has no such body", names)
    return FootBody(side, 1 + names.index(name), "named in robot.toml")


def _lowest_pair(tree: KinematicTree) -> tuple[FootBody, FootBody]:
    remedy = "name them in robot.toml: [feet.left] body = ..., [feet.right] body = ...; "
    remedy += "or the base's frame does not lie x forward, z up: say how it does, [base] forward = ..., up = ..."
    ends = [(lowest_height(tree, body), body) for body in tree.leaves() if len(tree.chain(body)) >= _FEWEST_HINGES]
    ends = sorted((height, body) for height, body in ends if height is not None)
    if len(ends) < 2:
        raise RefusedError("feet", f"{len(ends)} chains of {_FEWEST_HINGES} or more hinges end in a shape", remedy)
    one, other = (body for _, body in ends[:2])
    in_base = {
        body: tree.rotation(tree.base).T @ (tree.position(body) - tree.position(tree.base)) for body in (one, other)
    }
    apart = in_base[one] * (1.0, -1.0, 1.0) - in_base[other]
    names = f"{tree.body_name(one)} and {tree.body_name(other)}"
    if in_base[one][1] * in_base[other][1] >= 0.0:
        raise RefusedError("feet", f"the two lowest ends, {names}, do not lie left and right of the base", remedy)
    if np.abs(apart).max() > _MIRRORED_M:
        worst = f"{1e3 * np.abs(apart).max():.0f} mm"
        raise RefusedError(
            "feet", f"the two lowest ends, {names}, are no mirror images in the posture ({worst})", remedy
        )
    left, right = (one, other) if in_base[one][1] > 0.0 else (other, one)
    how = "the two lowest ends of chains, mirrored about the base's xz plane"
    return FootBody(Side.LEFT, left, how), FootBody(Side.RIGHT, right, how)
