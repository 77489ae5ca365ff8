"""Every contact point of the robot with its force: the simulator's truth, for views and checks only."""

import mujoco
import numpy as np

from surefoot.simulation.plant import Plant

_TOUCHING_M = 0.001  # as deep as a sole sinks in under the robot's own weight, and some more


def contact_forces(plant: Plant) -> np.ndarray:
    """Contact points and the forces there on the robot, (n, 6): point [m] and force [N] in world."""
    model, data = plant.model, plant.data
    rows = []
    wrench = np.empty(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        mujoco.mj_contactForce(model, data, i, wrench)
        force = contact.frame.reshape(3, 3).T @ wrench[:3]  # on geom2, by geom1
        on_second = model.body_weldid[model.geom_bodyid[contact.geom[1]]] != 0 and (
            model.body_mocapid[model.geom_bodyid[contact.geom[1]]] < 0
        )
        rows.append(np.concatenate((contact.pos, force if on_second else -force)))
    return np.array(rows) if rows else np.empty((0, 6))


def stones_in_robot(plant: Plant) -> dict[int, float]:
    """Stones that reach into the robot now: number in order of placing -> depth [m], the deepest contact of each."""
    model, data = plant.model, plant.data
    mujoco.mj_forward(model, data)
    found: dict[int, float] = {}
    for i in range(data.ncon):
        contact = data.contact[i]
        for geom in contact.geom:
            number, depth = plant.stones.number_of(int(geom)), -float(contact.dist)
            if number is not None and depth > _TOUCHING_M:
                found[number] = max(depth, found.get(number, 0.0))
    return dict(sorted(found.items()))
