"""Everything that decides the future of a simulation, kept aside so that it can be put back to the bit.

Our own side follows one generic rule, so that what is added to stones, ground or loop is kept without a line here:
every attribute of simulation, plant, stones and ground is copied deeply, but for what never changes or is kept
otherwise (robot, reference, recorder, MuJoCo's own structures). So is the controller, whatever it remembers.

MuJoCo's side is the state, what the last step left behind, and every number of the model but the shapes of meshes
(Unitree's G1 has 50 MB of them, which nothing changes while a simulation lasts). A step leaves more than the
state: poses, Jacobians and contacts of the instant before it, which the next tick's sensing and pushes read. Copying
all of that (``MjData``, 0.6 MB each) is not needed: it follows from the state before that step, so both states are
kept (4 kB each) and the step is made again.
"""

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from surefoot.errors import InvalidInput

_WHOLE = int(mujoco.mjtState.mjSTATE_INTEGRATION)  # with warm start, controls, forces and mocap poses
_NEVER_CHANGED = ("mesh_", "bvh_", "oct_", "skin_", "tex_")  # shapes, trees of boxes about them, pictures


@dataclass(frozen=True, slots=True, eq=False)
class WorldState:
    """One kept instant.

    Attributes:
        before: MuJoCo's integration state before the last step; None before the first.
        now: the same after it, with what was changed since.
        places, values: the bytes of the model's numbers that differ from what they first were.
    """

    before: np.ndarray | None
    now: np.ndarray
    places: np.ndarray
    values: np.ndarray


class WorldMemory:
    """Keeps and puts back the state of one MuJoCo world.

    Args:
        model, data: the world; both are changed in place when a state is put back.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData):
        self._model, self._data = model, data
        self._before = np.empty(mujoco.mj_stateSize(model, _WHOLE))
        self._stepped = False
        self._numbers = ModelNumbers(model)
        self._first: np.ndarray | None = None

    def note_step(self) -> None:
        """To be called just before every ``mj_step``."""
        mujoco.mj_getState(self._model, self._data, self._before, _WHOLE)
        self._stepped = True

    @property
    def stepped(self) -> bool:
        """Whether a step was made since the world was restarted."""
        return self._stepped

    def note_reset(self) -> None:
        """To be called when the world is restarted."""
        self._stepped = False

    def save_state(self) -> WorldState:
        """The world as it is now."""
        now = np.empty_like(self._before)
        mujoco.mj_getState(self._model, self._data, now, _WHOLE)
        numbers = self._numbers.copy()
        if self._first is None:
            self._first = numbers
        places = np.flatnonzero(numbers != self._first)
        return WorldState(self._before.copy() if self._stepped else None, now, places, numbers[places])

    def restore_state(self, state: WorldState) -> None:
        """Make the world what it was, in place. Only for a state that this memory has kept."""
        self._restore_model(state)
        self._stepped = state.before is not None
        if state.before is None:
            mujoco.mj_setState(self._model, self._data, state.now, _WHOLE)
            mujoco.mj_forward(self._model, self._data)
        else:
            self._before[:] = state.before
            mujoco.mj_setState(self._model, self._data, state.before, _WHOLE)
            mujoco.mj_step(self._model, self._data)
        mujoco.mj_setState(self._model, self._data, state.now, _WHOLE)

    def _restore_model(self, state: WorldState) -> None:
        assert self._first is not None
        wanted = self._first.copy()
        wanted[state.places] = state.values
        self._numbers.paste(wanted)


class ModelNumbers:
    """All numbers of a MuJoCo model that may change while it lives, as one row of bytes.

    Args:
        model: whose numbers they are: its arrays, and arrays and single numbers of ``opt`` and ``stat``.
    """

    def __init__(self, model: mujoco.MjModel):
        self._arrays: list[np.ndarray] = []
        self._singles: list[tuple[Any, str, type]] = []
        for structure in (model, model.opt, model.stat):
            for name in dir(structure):
                value = None if name.startswith(("_", *_NEVER_CHANGED)) else getattr(structure, name)
                if isinstance(value, np.ndarray):
                    if value.size:
                        self._arrays.append(value.reshape(-1).view(np.uint8))  # the model's own memory
                elif isinstance(value, int | float) and structure is not model:  # a model's own are sizes
                    self._singles.append((structure, name, type(value)))
        self._ends = np.cumsum([array.size for array in self._arrays])

    def copy(self) -> np.ndarray:
        """(bytes,) of all of them as they are now."""
        singles = np.array([getattr(structure, name) for structure, name, _ in self._singles], float)
        return np.concatenate((*self._arrays, singles.view(np.uint8)))

    def paste(self, numbers: np.ndarray) -> None:
        """Make them what they were: ``copy`` backwards."""
        *arrays, singles = np.split(numbers, self._ends)
        for mine, its in zip(self._arrays, arrays, strict=True):
            mine[:] = its
        for (structure, name, kind), value in zip(self._singles, singles.view(float).tolist(), strict=True):
            setattr(structure, name, kind(value))


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
