"""What the simulator knows of the balance of one tick: for metrics, events and views, never for a controller."""

import mujoco
import numpy as np

from surefoot.geometry.polygon import convex_hull
from surefoot.geometry.rotations import cross
from surefoot.momentum.zmp import centre_of_pressure
from surefoot.record import record
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.simulation.plant import FootTruth, Plant

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


_LOADED_N = 20.0  # below this a foot's centre of pressure means nothing (Bip's, others' in proportion)


@record
class BalanceMeasurement:
    """Measured ZMP and what it is held against.

    Attributes:
        normal_forces: vertical force on each foot [N].
        zmp_in_world: measured ZMP (2,) [m]; NaN when the support carries nothing.
        zmp_margin: signed distance [m] from it to the edge of the true sole polygon; NaN likewise.
        contact_moment: of the ground about ``origin`` (3,) in world [N m].
        origin: P below the stance ankle, or midway between both (3,) in world [m].
    """

    normal_forces: tuple[float, float]
    zmp_in_world: np.ndarray
    zmp_margin: float
    contact_moment: np.ndarray
    origin: np.ndarray


def measured_delta(balance: BalanceMeasurement, com: np.ndarray, weight_n: float) -> np.ndarray:
    """delta_P (3,) [N m] in world, from the ground's moment: what the contacts give less what the weight takes.

    Args:
        balance: of the tick; its origin is P.
        com: G (3,) in world [m].
        weight_n: m g [N].
    """
    return balance.contact_moment - cross(com - balance.origin, np.array((0.0, 0.0, weight_n)))


def measure_balance(robot: RobotDescription, feet: tuple[FootTruth, FootTruth], support: Support) -> BalanceMeasurement:
    """Measured ZMP of the support feet against their true soles.

    Single support: the centre of pressure in the stance sole's own plane, against the sole. Double support: that of
    both feet together in the horizontal plane midway between both P, against the convex hull of both soles.
    """
    normal = (float(feet[0].force[2]), float(feet[1].force[2]))
    loaded = _LOADED_N * robot.sizes.weight
    if support is not Support.DOUBLE:
        i = support.reference_foot
        foot, truth = robot.feet[i], feet[i]
        R = truth.rotation
        origin = foot.point_below(truth.position_ankle, R)
        moment = truth.moment + cross(truth.position_ankle - origin, truth.force)
        local_force, local_moment = truth.force.dot(R), moment.dot(R)
        if local_force[2] < loaded:
            return BalanceMeasurement(normal, np.full(2, np.nan), np.nan, moment, origin)
        cop = centre_of_pressure(local_force, local_moment)
        return BalanceMeasurement(normal, origin[:2] + R[:2, :2].dot(cop), foot.sole.signed_margin(cop), moment, origin)
    points = [
        foot.point_below(truth.position_ankle, truth.rotation) for foot, truth in zip(robot.feet, feet, strict=True)
    ]
    origin = 0.5 * (points[0] + points[1])
    force = feet[0].force + feet[1].force
    moment = np.zeros(3)
    for truth in feet:
        moment += truth.moment + cross(truth.position_ankle - origin, truth.force)
    if force[2] < loaded:
        return BalanceMeasurement(normal, np.full(2, np.nan), np.nan, moment, origin)
    zmp = origin[:2] + centre_of_pressure(force, moment)
    polygon = convex_hull(np.vstack([sole_outline(robot, truth, i) for i, truth in enumerate(feet)]).tolist())
    return BalanceMeasurement(normal, zmp, polygon.signed_margin(zmp), moment, origin)


def sole_outline(robot: RobotDescription, truth: FootTruth, foot: int) -> np.ndarray:
    """Corners (n, 2) of a sole seen from above, in world [m]."""
    corners = robot.feet[foot].corners_from_ankle
    return (truth.position_ankle + corners.dot(truth.rotation.T))[:, :2]
