"""What is known before anything moves: the capture bound of a push, and how far a swing's reference goes.

The bound is what no controller beats without a step or angular momentum.
"""

import math
from dataclasses import dataclass

import numpy as np

from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import COM
from surefoot.errors import InvalidInput, PostureError
from surefoot.experiments.scenario.references import feet_at_start, plan_scenario, start_posture, unplanned_reference
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.gait.emergency_step import landing_time
from surefoot.gait.step_bound import one_step_impulse
from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.momentum.zmp import capture_impulse, capture_point, linear_impulse, natural_frequency
from surefoot.simulation.external_forces import Push
from surefoot.simulation.loop import TickResult
from surefoot.simulation.walk_causes import WalkWatch


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


def step_impulse(scenario: Scenario) -> float:
    """J_cap1 [N s]: the greatest impulse of the scenario's first push that one emergency step can catch, from rest.

    See ``one_step_impulse``. From two feet the better stance foot counts, and never less than what needs no step.
    """
    push, bound = scenario.pushes[0], push_bound(scenario)
    robot, feet = scenario.robot_description(), feet_at_start(scenario)
    if push.duration_s > landing_time(robot):
        reason = "the one-step bound is for pushes that are over when the step lands"
        raise InvalidInput("pushes.0.duration_s", push.duration_s, reason, [f"up to {landing_time(robot):.3g} s"])
    stances = [feet[i] for i in scenario.support.stance]
    mass, omega, direction = bound.mass_kg, bound.omega, bound.direction
    caught = one_step_impulse(
        robot, stances, bound.com, direction, mass_kg=mass, omega=omega, duration_s=push.duration_s
    )
    return max(bound.impulse_ns, caught)


@dataclass(frozen=True)
class WalkingBound:
    """J_cap1 of a push in the middle of a walk.

    Attributes:
        impulse_ns: the greatest impulse that the next step can catch [N s]; 0 where the capture point is lost already.
        landing_s: time until that step lands as planned [s]; NaN where none is to come: then J_cap.
    """

    impulse_ns: float
    landing_s: float


def walking_bound(
    watch: WalkWatch, result: TickResult, mass_kg: float, direction: np.ndarray, duration_s: float
) -> WalkingBound:
    """J_cap1 of a walk at one tick, the next step going to anywhere that a step may be planned to, at its time.

    It is an upper bound, and a wide one just before a landing: how far the foot still gets until then is not counted.

    The capture point's way is linear, so a constant force of duration T counts as if the point had begun
    J (1 - e^(-omega T)) / (m omega^2 T) farther along the push, whether it lasts beyond the landing or not; the
    greatest J is that of ``capture_impulse`` with the region that can be caught now in place of the soles.

    Args:
        watch: of the walk.
        result: of the tick in which the push begins; it made a step.
        mass_kg: m of the plant.
        direction: unit vector of the push (2,) in world.
        duration_s: T of the push [s].
    """
    terms = result.terms
    assert terms is not None
    omega = natural_frequency(float(terms.position_com_in_world[2] - result.balance.origin[2]), terms.gravity)
    region, stance, landing_s = watch.region(terms, omega)
    capture = result.capture
    if stance is not None:
        capture, direction = (capture - stance.point).dot(stance.axes), direction.dot(stance.axes)
    if not region.contains(capture):
        return WalkingBound(0.0, landing_s)
    return WalkingBound(capture_impulse(mass_kg, omega, region, capture, direction, duration_s), landing_s)


_STEP_S = 0.001


@dataclass(frozen=True)
class Excursion:
    """Least margins [m] over the swing to the edge of the true sole; negative: outside.

    Attributes:
        zmp_margin_m: of the planned ZMP; NaN when the swing cannot be reached.
        capture_margin_m: of the reference's capture point x + x'/omega.
    """

    zmp_margin_m: float
    capture_margin_m: float


def swing_excursion(scenario: Scenario) -> Excursion:
    """ZMP and capture point of a scenario's swing, followed exactly."""
    try:
        zmp = float(plan_scenario(scenario).margin_m.min())
    except PostureError:
        zmp = math.nan
    return Excursion(zmp, capture_margin(scenario, _STEP_S))


def capture_margin(scenario: Scenario, step_s: float) -> float:
    """Least margin [m] of the reference's capture point over the swing, looked at every ``step_s``."""
    spec, posture = scenario.reference, start_posture(scenario)
    polygon, reference = support_polygon_at_rest(scenario), unplanned_reference(spec, posture)
    omega = natural_frequency(float(posture.position_com[2]), scenario.robot_description().gravity)
    margin = math.inf
    for time_s in np.arange(0.0, spec.duration_s + step_s, step_s).tolist():
        wanted = reference.at(spec.start_s + time_s)
        xi = capture_point(wanted.position_com, wanted.velocity[COM], omega)
        margin = min(margin, polygon.signed_margin(xi))
    return margin
