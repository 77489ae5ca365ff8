"""The legs: the joints on the way from each foot to the base that are not on the way from both."""

from surefoot.record import record
from surefoot.robot.leg_chains import LEG_JOINTS, apart
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.problem import Problem


@record
class Legs:
    """Joints by what they move.

    Attributes:
        left, right: hinges of each leg, from the hip down.
        upper: hinges in no leg; one above both feet (the waist of a robot whose trunk is the base) is one of them.
    """

    left: list[int]
    right: list[int]
    upper: list[int]


def find_legs(tree: KinematicTree, left_foot: int, right_foot: int) -> Legs:
    """What the two chains from base to foot do not share."""
    left, right = apart(tree.chain(left_foot), tree.chain(right_foot))
    return Legs(list(left), list(right), [joint for joint in tree.hinges if joint not in {*left, *right}])


def leg_problems(tree: KinematicTree, legs: Legs) -> list[Problem]:
    """What keeps the task Jacobian H from being square: legs of other than six joints."""
    counts = (len(legs.left), len(legs.right))
    if counts == (LEG_JOINTS, LEG_JOINTS):
        return []
    kinds = ("five", "six", "seven")
    word = kinds[counts[0] - 5] if counts[0] == counts[1] and 5 <= counts[0] <= 7 else None
    what = f"{word}-joint legs" if word else f"legs of {counts[0]} and {counts[1]} joints"
    names = ", ".join(tree.joint_names(legs.left))
    if max(counts) > LEG_JOINTS:
        remedy = "freeze the joints beyond six (a toe, say): `frozen` in robot.toml"
    else:
        remedy = "none here: the two-part law needs six joints in each leg, so that each foot can be placed freely"
    return [Problem("legs", f"{what}, the left one is {names}", remedy)]
