"""What the plant computed in one tick, read from MuJoCo's own arrays and put into our coordinates."""

from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np
import pytest

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.simulation.loop import Simulation, TickResult


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredTick:
    """One tick as MuJoCo computed it, by roads that the program itself does not take.

    Attributes:
        tick: what the loop returned.
        terms: dynamics at the state that MuJoCo stepped from.
        acceleration: q'' (21,), MuJoCo's, in Pinocchio's layout.
        contact_points: (n, 3) in world [m].
        contact_forces: (n, 3) on the robot, in world [N].
    """

    tick: TickResult
    terms: DynamicsTerms
    acceleration: np.ndarray
    contact_points: np.ndarray
    contact_forces: np.ndarray

    def contact_moment_about(self, point: np.ndarray) -> np.ndarray:
        """Moment of all contact forces about a point (3,) [N m]."""
        return np.cross(self.contact_points - point, self.contact_forces).sum(axis=0)


@pytest.fixture(scope="session")
def measured_tick() -> Callable[[Simulation], MeasuredTick]:
    """Advance a simulation by one tick and read what MuJoCo made of it.

    With the contact solver's tolerance set to zero it iterates until rounding stops it, so that laws of mechanics hold
    to rounding and not only to the solver's default precision.
    """

    def advance(simulation: Simulation) -> MeasuredTick:
        model, data = simulation.plant.model, simulation.plant.data
        model.opt.tolerance = model.opt.ls_tolerance = 0.0
        tick = simulation.tick()
        assert tick.terms is not None
        R, v = tick.terms.rotation_pelvis_to_world, tick.terms.state.v
        acceleration = data.qacc.copy()
        acceleration[:3] = R.T @ data.qacc[:3] - np.cross(v[3:6], v[:3])  # world -> rate of the pelvis-frame velocity

        points, forces = [], []
        for i, contact in enumerate(data.contact):
            in_frame = np.zeros(6)
            mujoco.mj_contactForce(model, data, i, in_frame)
            on_second = contact.frame.reshape(3, 3).T @ in_frame[:3]
            sign = 1.0 if model.geom_bodyid[contact.geom[0]] == 0 else -1.0  # the other geom is the ground's
            points.append(contact.pos.copy())
            forces.append(sign * on_second)
        return MeasuredTick(
            tick=tick,
            terms=tick.terms,
            acceleration=acceleration,
            contact_points=np.array(points),
            contact_forces=np.array(forces),
        )

    return advance
