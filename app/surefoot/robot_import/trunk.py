"""The trunk: the body that must stay up."""

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.legs import Legs

_GUESSED = "the heaviest body that is in no leg; trunk in robot.toml chooses another"


@record
class Trunk:
    """The trunk.

    Attributes:
        body: its index.
        how: how it was found.
    """

    body: int
    how: str


def find_trunk(tree: KinematicTree, legs: Legs, said: str | None) -> Trunk:
    """What robot.toml names, else the heaviest body that no leg moves. Raises InvalidInput."""
    model = tree.model
    if said is not None:
        names = [tree.body_name(body) for body in range(1, model.nbody)]
        if said not in names:
            raise InvalidInput("trunk", said, "the model has no such body", names)
        return Trunk(1 + names.index(said), "named in robot.toml")
    in_leg = {*legs.left, *legs.right}
    bodies = [body for body in range(1, model.nbody) if not in_leg & set(tree.chain(body))]
    if not bodies:  # the base hangs below the legs' common joints only in a file that is no biped
        return Trunk(tree.base, "the base")
    return Trunk(max(bodies, key=lambda body: float(model.body_mass[body])), _GUESSED)
