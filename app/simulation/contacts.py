"""Every contact point of the robot with its force: the simulator's truth, for views only."""

import mujoco
import numpy as np

from app.simulation.plant import Plant


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
