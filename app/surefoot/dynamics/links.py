"""Motion of every single link for a given q'': the long road to delta_P, for its planar forms and for the tests."""

from dataclasses import dataclass

import numpy as np

from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.link_chains import carried_links
from surefoot.robot.pinocchio_library import pin


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinkMotions:
    """The n links of a robot, one row each; world axes unless said otherwise.

    Attributes:
        names: n link names.
        mass_kg: (n,).
        position_com: (n, 3) G_i [m].
        velocity_com: (n, 3) [m/s].
        acceleration_com: (n, 3) gamma_Gi [m/s2], gravity not included.
        rotation_link_to_world: (n, 3, 3) R_i.
        inertia_at_com: (n, 3, 3) I_i [kg m2], link axes.
        omega: (n, 3) angular velocity [rad/s], link axes.
        omega_dot: (n, 3) angular acceleration [rad/s2], link axes.
    """

    names: tuple[str, ...]
    mass_kg: np.ndarray
    position_com: np.ndarray
    velocity_com: np.ndarray
    acceleration_com: np.ndarray
    rotation_link_to_world: np.ndarray
    inertia_at_com: np.ndarray
    omega: np.ndarray
    omega_dot: np.ndarray


def evaluate_links(robot: RobotDescription, state: RobotState, acceleration: np.ndarray) -> LinkMotions:
    """Kinematics of every link.

    Args:
        robot: the robot.
        state: configuration and velocity.
        acceleration: q'' (n,), derivative of ``state.v``.
    """
    model = robot.pinocchio_model
    data = model.createData()
    pin.forwardKinematics(model, data, state.q, state.v, acceleration)
    links = carried_links(model)
    joints = [joint for joint in range(1, model.njoints) if joint in links]
    rows = []
    for joint in joints:
        R, lever = data.oMi[joint].rotation, model.inertias[joint].lever
        w, w_dot = data.v[joint].angular, data.a[joint].angular
        velocity = data.v[joint].linear + np.cross(w, lever)
        classical = data.a[joint].linear + np.cross(w, data.v[joint].linear)  # spatial -> of the point
        acceleration_com = classical + np.cross(w_dot, lever) + np.cross(w, np.cross(w, lever))
        rows.append(
            (
                model.inertias[joint].mass,
                data.oMi[joint].act(lever),
                R @ velocity,
                R @ acceleration_com,
                R.copy(),
                model.inertias[joint].inertia,
                w.copy(),
                w_dot.copy(),
            )
        )
    mass, com, velocity, gamma, R, inertia, w, w_dot = (np.array(column) for column in zip(*rows, strict=True))
    return LinkMotions(
        names=tuple(links[joint] for joint in joints),
        mass_kg=mass,
        position_com=com,
        velocity_com=velocity,
        acceleration_com=gamma,
        rotation_link_to_world=R,
        inertia_at_com=inertia,
        omega=w,
        omega_dot=w_dot,
    )
