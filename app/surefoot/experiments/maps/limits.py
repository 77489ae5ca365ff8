"""What physics allows, as curves over a whole map."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from surefoot.dynamics.model import DynamicsModel
from surefoot.dynamics.terms import COM
from surefoot.errors import PostureError
from surefoot.experiments.bench.ladders import BIP
from surefoot.experiments.scenario.bounds import push_bound, support_polygon_at_rest
from surefoot.experiments.scenario.proportions import proportions_of, scaled
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.experiments.scenario.references import plan_scenario, start_posture, unplanned_reference
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.momentum.zmp import capture_point, natural_frequency
from surefoot.robot.feet import Support
from surefoot.simulation.external_forces import Push
from surefoot.task.posture import solve_posture

_TRIAL_M = 0.02


def capture_curve(support: Support, push_duration_s: float, directions_deg: np.ndarray, robot: str = BIP) -> np.ndarray:
    """J_cap(T) (n,) [N s] of pushes in many directions (n,) [deg], from rest, against the true support polygon."""
    scenario = Scenario(robot=robot, support=support)
    return np.array(
        [
            push_bound(scenario, Push(direction_deg=angle, impulse_ns=1.0, duration_s=push_duration_s)).impulse_ns
            for angle in directions_deg.tolist()
        ]
    )


def ankle_stop_height(place: tuple[float, float], size_m: Sequence[float], support: Support, robot: str = BIP) -> float:
    """Height [m] of a stone from which the stance ankle stands at its frontal stop while the CoM stays in place.

    The sole, rigid, turns about its inner edge and rests on the stone's inner upper edge. Infinite where the sole does
    not rest so, because the CoM is not between the two: it tips another way. Not a bound: with the ankle at its stop a
    robot can still lean.

    Args:
        place: middle of the stone (x, y) from the point below the ankle [m].
        size_m: its length and width.
        support: left or right.
        robot: as a scenario names it.
    """
    scenario = Scenario(robot=robot, support=support)
    description = scenario.robot_description()
    foot = description.feet[support.reference_foot]
    joint = next(joint for joint in description.joints if joint.dof == foot.frontal)
    posture = start_posture(scenario)
    angle = solve_posture(DynamicsModel(description), posture).q[joint.dof + 1]
    outward = np.array((0.0, 1.0 if support.reference_foot == 0 else -1.0))
    inner = int((foot.sole.normals @ outward).argmin())
    edge = foot.sole.vertices[[inner, (inner + 1) % len(foot.sole.vertices)]]
    length, width = size_m
    stone = np.array(place) - 0.5 * width * outward + 0.5 * length * np.array(((-1.0, 0.0), (1.0, 0.0)))
    com = posture.position_com[:2] - posture.position_ankles[support.reference_foot][:2]
    lever = float((foot.sole.offsets[inner] - stone @ foot.sole.normals[inner]).min())
    if lever <= 0.0 or not convex_hull(np.vstack((edge, stone)).tolist()).contains(com):
        return np.inf
    return lever * float(np.tan(joint.upper_rad - angle))


@dataclass(frozen=True, eq=False)
class SwingLimits:
    """Amplitudes [m] at which a swing's reference leaves the sole, over its duration.

    Attributes:
        duration_s: (n,).
        zmp_m: (n,) from here on its own ZMP is outside, whole body counted.
        capture_m: (n,) from here on its capture point is outside: no controller can follow and stay.
    """

    duration_s: np.ndarray
    zmp_m: np.ndarray
    capture_m: np.ndarray


def swing_limits(
    axis: str, sign: float, durations_s: np.ndarray, support: Support = Support.LEFT, robot: str = BIP
) -> SwingLimits:
    """Both limits of swings along an axis; NaN where the trial swing cannot be reached.

    The path is affine in the amplitude, so one trial swing a duration tells all amplitudes (its ZMP to first order).
    """
    trial = scaled(_TRIAL_M, proportions_of(robot).along(axis))
    found = [
        _limits(
            Scenario(
                robot=robot,
                support=support,
                reference=ReferenceSpec(
                    kind="swing", axis=axis, amplitude_m=sign * trial, duration_s=duration, start_s=0.1
                ),
            )
        )
        for duration in durations_s.tolist()
    ]
    zmp, capture = np.array(found).T
    return SwingLimits(durations_s, zmp, capture)


def _limits(scenario: Scenario) -> tuple[float, float]:
    polygon, posture, spec = support_polygon_at_rest(scenario), start_posture(scenario), scenario.reference
    omega = natural_frequency(float(posture.position_com[2]), scenario.robot_description().gravity)
    reference = unplanned_reference(spec, posture)
    times = spec.start_s + np.linspace(0.0, spec.duration_s, 200)
    wanted = [reference.at(time_s) for time_s in times.tolist()]
    path = np.array([capture_point(w.position_com, w.velocity[COM], omega) for w in wanted])
    trial_m = abs(spec.amplitude_m)
    capture = _amplitude_at_edge(polygon, path, trial_m)
    try:
        path = plan_scenario(replace(scenario, duration_s=spec.start_s + spec.duration_s)).zmp_in_world
    except PostureError:
        return np.nan, capture
    return _amplitude_at_edge(polygon, path, trial_m), capture


def _amplitude_at_edge(polygon: ConvexPolygon, path: np.ndarray, trial_m: float) -> float:
    """By how much the trial's path (n, 2), which starts at rest, must be scaled to touch an edge, times its size."""
    start = path[0]
    outward = (path - start) @ polygon.normals.T
    room = polygon.offsets - polygon.normals @ start
    return float(trial_m * np.min(room / np.maximum(outward.max(axis=0), 1e-12)))
