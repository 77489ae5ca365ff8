"""Controllers that do as they are told, for testing the plant and the loop around them."""

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

from surefoot.control.interface import ControlOutput, Status
from surefoot.simulation.conventions import qpos_from_q
from surefoot.simulation.loop import Simulation


class Scripted:
    """A controller whose torques (15,) are a function of the number of its tick."""

    def __init__(self, torques_at: Callable[[int], np.ndarray], *, infeasible: bool = False):
        self._torques_at, self._infeasible, self._tick = torques_at, infeasible, 0

    def reset(self, last_torques=None) -> None:
        pass

    def tick(self, terms, reference, sensing) -> ControlOutput:
        torques = self._torques_at(self._tick)
        self._tick += 1
        nothing = np.zeros(2)
        return ControlOutput(
            torques=torques,
            status=Status.HOLDING if self._infeasible else Status.SOLVED,
            zmp_wanted_in_world=nothing,
            zmp_commanded_in_world=nothing,
            delta_commanded=np.zeros(3),
            infeasible=self._infeasible,
        )


@pytest.fixture(scope="session")
def scripted() -> type[Scripted]:
    return Scripted


@pytest.fixture
def limp(simulate, scripted) -> Callable[..., Simulation]:
    """A simulation whose controller asks for constant torques (none, unless told)."""

    def build(torques: np.ndarray | None = None, *, infeasible: bool = False, **scenario) -> Simulation:
        simulation = simulate(**scenario)
        asked = np.zeros(15) if torques is None else torques
        simulation.controller = scripted(lambda tick: asked, infeasible=infeasible)
        return simulation

    return build


@pytest.fixture(scope="session")
def put() -> Callable[[Simulation, np.ndarray], None]:
    """Put the robot of a simulation at rest into a configuration."""

    def place(simulation: Simulation, q: np.ndarray) -> None:
        data = simulation.plant.data
        data.qpos[:], data.qvel[:] = qpos_from_q(q), 0.0
        mujoco.mj_forward(simulation.plant.model, data)

    return place
