"""Everything that decides the future of a simulation, kept aside so that it can be put back to the bit.

The rule is generic, so that what is added to stones, ground or loop is kept without a line here: every attribute of
simulation, plant, stones and ground is copied deeply, but for what never changes or is kept otherwise (robot,
reference, recorder, MuJoCo's own structures). So is the controller, whatever it remembers.
"""

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.simulation.world_state import WorldState


@dataclass(frozen=True, slots=True, eq=False)
class Checkpoint:
    """One kept instant of a simulation; it can be put back any number of times, into the simulation that made it.

    Attributes:
        time_s: simulated time [s].
        world: MuJoCo's side.
        attributes: those of every object that changes, in a fixed order.
        rows: how many rows the recorder had written.
    """

    time_s: float
    world: WorldState
    attributes: tuple[dict[str, Any], ...]
    rows: int


def copy_attributes(objects: Sequence[object], shared: Sequence[object]) -> tuple[dict[str, Any], ...]:
    """Deep copies of what objects hold.

    Args:
        objects: whose attributes are copied; one that holds another one keeps holding the living one.
        shared: what is not copied wherever it is met.

    Raises:
        InvalidInput: something in there cannot be copied; of ours everything can, so it is an outside controller's.
    """
    try:
        return copy.deepcopy(tuple(dict(vars(thing)) for thing in objects), _memo(objects, shared))
    except Exception as error:  # whatever someone else's __deepcopy__ raises
        name = type(getattr(objects[0], "controller", None)).__name__
        reason = f"cannot be copied ({type(error).__name__}: {error}), so that nothing can be rewound while it drives"
        raise InvalidInput("controller", name, reason, ["one with a __deepcopy__ that works"]) from error


def restore_attributes(
    objects: Sequence[object], shared: Sequence[object], attributes: Sequence[dict[str, Any]]
) -> None:
    """Give objects the attributes they had; the kept ones stay untouched, so that this can be done again."""
    for thing, held in zip(objects, copy.deepcopy(attributes, _memo(objects, shared)), strict=True):
        vars(thing).clear()
        vars(thing).update(held)


def _memo(objects: Sequence[object], shared: Sequence[object]) -> dict[int, Any]:
    return {id(thing): thing for thing in (*objects, *shared)}
