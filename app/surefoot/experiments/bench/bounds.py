"""The capture bound of a scenario's push: what no controller beats without a step or angular momentum."""

from dataclasses import dataclass

import numpy as np

from surefoot.control.settings import ControllerSettings
from surefoot.experiments.scenario.references import start_posture
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.momentum.capture import capture_impulse, linear_impulse, natural_frequency
from surefoot.simulation.pushes import Push


@dataclass(frozen=True, eq=False)
class CaptureBound:
    """J_cap of a push and what it was computed from.

    Attributes:
        impulse_ns: J_cap(T) for the push's own duration [N s].
        mass_kg: of the plant.
        omega: natural frequency [rad/s] of the CoM at rest.
        com: its ground projection (2,) at rest [m].
        direction: unit vector of the push (2,).
        normal, offset: the edge that the CoM would leave over, outward normal (2,) and offset [m].
        duration_s: T.
    """

    impulse_ns: float
    mass_kg: float
    omega: float
    com: np.ndarray
    direction: np.ndarray
    normal: np.ndarray
    offset: float
    duration_s: float

    def linear_impulse_ns(self, settings: ControllerSettings) -> float:
        """J_lin = J_cap omega / K_D: the impulse at which a PD law on the CoM saturates the CoP."""
        return linear_impulse(self.impulse_ns, self.omega, settings.com_damping)


def support_polygon_at_rest(scenario: Scenario) -> ConvexPolygon:
    """The true support polygon in world [m], soles where the scenario starts."""
    posture, robot = start_posture(scenario), scenario.robot_description()
    corners = [
        (posture.position_ankles[i] + robot.feet[i].corners_from_ankle @ posture.rotation_feet_to_world[i].T)[:, :2]
        for i in scenario.support.stance
    ]
    return convex_hull(np.vstack(corners).tolist())


def push_bound(scenario: Scenario, push: Push | None = None) -> CaptureBound:
    """J_cap of a push (of the scenario's first by default), from the CoM at rest."""
    push = push or scenario.pushes[0]
    robot, com = scenario.robot_description(), start_posture(scenario).position_com
    polygon = support_polygon_at_rest(scenario)
    mass = robot.mass_kg * scenario.physics.mass_scale
    omega = natural_frequency(float(com[2]), robot.gravity)
    direction = push.direction
    impulse = capture_impulse(mass, omega, polygon, com[:2], direction, push.duration_s)
    speed = polygon.normals @ direction
    distance = np.full(len(speed), np.inf)
    ahead = speed > 1e-12
    distance[ahead] = (polygon.offsets - polygon.normals @ com[:2])[ahead] / speed[ahead]
    edge = int(distance.argmin())
    return CaptureBound(
        impulse, mass, omega, com[:2], direction, polygon.normals[edge], float(polygon.offsets[edge]), push.duration_s
    )
