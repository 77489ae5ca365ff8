"""Measures the distance to every limit, from the living simulation. Called by the session's thread only."""

import numpy as np

from surefoot.dashboard.live.observation.plot_rows import support_polygon
from surefoot.dashboard.messages.limits import Gauge, LimitMargins, PushBound, StepBound
from surefoot.dashboard.messages.snapshot import LOADED_N
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.emergency_step import landing_time, step_reach
from surefoot.gait.footsteps import feet_now
from surefoot.gait.recovering_walk import RecoveringWalk
from surefoot.gait.step_bound import one_step_impulse
from surefoot.gait.step_when_needed import StepWhenNeeded
from surefoot.geometry.polygon import ConvexPolygon
from surefoot.momentum.zmp import capture_impulse, natural_frequency
from surefoot.robot.description import BASE_DOFS
from surefoot.simulation.external_forces import Push
from surefoot.simulation.loop import Simulation, TickResult

_UNKNOWN = float("nan")
_EDGES = ("heel edge", "toe edge", "right edge", "left edge")


class LimitMonitor:
    """Remembers the last push and measures the limits of one run.

    Args:
        simulation: what to look at.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._push: PushBound | None = None
        self._seen: frozenset[Push] = frozenset()

    def save_state(self) -> tuple[PushBound | None, frozenset[Push]]:
        """What is remembered now, for ``restore_state``."""
        return self._push, self._seen

    def restore_state(self, kept: tuple[PushBound | None, frozenset[Push]]) -> None:
        """Remember what was remembered then."""
        self._push, self._seen = kept

    def look(self, result: TickResult) -> None:
        """Notice a push that began with this tick."""
        for push in self._simulation.pushes:
            if push not in self._seen and result.terms is not None and push.active_at(result.terms.state.time_s):
                self._seen |= {push}
                self._push = self._bound(push, result)

    def view(self, result: TickResult | None) -> LimitMargins:
        """All limits as a tick left them."""
        if result is None or result.terms is None:
            return LimitMargins(push=self._push)
        polygon = support_polygon(self._simulation)
        gauges = (
            self._edge("zmp", result.balance.zmp_in_world, polygon, result.balance.zmp_margin),
            self._edge("dcm", result.capture, polygon, None),
            self._torque(result),
            self._joint(result.terms.state.q[BASE_DOFS + 1 :]),
            self._friction(),
        )
        return LimitMargins(gauges=gauges, push=self._push)

    def _bound(self, push: Push, result: TickResult) -> PushBound | None:
        polygon, terms = support_polygon(self._simulation), result.terms
        if polygon is None or terms is None or not np.isfinite(result.capture).all():
            return None
        height = float(terms.position_com_in_world[2] - result.balance.origin[2])
        omega = natural_frequency(height, terms.gravity)
        inside = polygon.contains(result.capture)
        mass = self._simulation.robot.mass_kg * self._simulation.plant.physics.mass_scale
        bound = 0.0
        if inside:
            bound = capture_impulse(mass, omega, polygon, result.capture, push.direction, push.duration_s)
        bound = max(bound, 0.0)
        return PushBound(
            start_s=push.start_s,
            duration_s=push.duration_s,
            direction_deg=push.direction_deg,
            impulse_ns=push.impulse_ns,
            bound_ns=bound,
            omega=omega,
            link=push.link,
            step=self._step(push, terms, result.capture, bound, mass_kg=mass, omega=omega),
        )

    def _step(
        self, push: Push, terms: DynamicsTerms, capture: np.ndarray, without_ns: float, *, mass_kg: float, omega: float
    ) -> StepBound | None:
        """What a step could catch, and no less than what needs none [N s]."""
        robot, gait = self._simulation.robot, self._simulation.gait
        if not isinstance(gait, StepWhenNeeded | RecoveringWalk) or not gait.stances:
            return None
        (ahead, aside), landing_s, feet = step_reach(robot), landing_time(robot), feet_now(robot, terms)
        if push.duration_s > landing_s:
            return None
        stances = [feet[i] for i in gait.stances]
        caught = one_step_impulse(
            robot, stances, capture, push.direction, mass_kg=mass_kg, omega=omega, duration_s=push.duration_s
        )
        return StepBound(
            bound_ns=max(caught, without_ns),
            ahead_m=ahead[1],
            back_m=-ahead[0],
            aside_m=aside[1],
            landing_s=landing_s,
        )

    def _edge(self, name: str, point: np.ndarray, polygon: ConvexPolygon | None, margin: float | None) -> Gauge:
        """A point against the edges of the soles; its margin may be known better than seen from above."""
        if polygon is None or not np.isfinite(point).all():
            return Gauge(name=name, label="no support", value=_UNKNOWN, unit="mm", used=_UNKNOWN)
        seen = polygon.offsets - polygon.normals @ point
        edge = int(seen.argmin())
        left = float(seen[edge]) if margin is None else margin
        widest = polygon.signed_margin(polygon.centroid)
        return Gauge(
            name=name, label=_edge_name(polygon.normals[edge]), value=1e3 * left, unit="mm", used=1.0 - left / widest
        )

    def _torque(self, result: TickResult) -> Gauge:
        robot = self._simulation.robot
        used = np.abs(result.applied) / robot.torque_limits
        worst = int(used.argmax())
        left = float(robot.torque_limits[worst] - abs(result.applied[worst]))
        return Gauge(
            name="torque", label=_joint_name(robot.joints[worst].name), value=left, unit="N·m", used=float(used[worst])
        )

    def _joint(self, angles: np.ndarray) -> Gauge:
        robot = self._simulation.robot
        left = np.minimum(angles - robot.joint_lower, robot.joint_upper - angles)
        used = 1.0 - left / (0.5 * (robot.joint_upper - robot.joint_lower))
        worst = int(used.argmax())
        return Gauge(
            name="joint",
            label=_joint_name(robot.joints[worst].name),
            value=1e3 * float(left[worst]),
            unit="mrad",
            used=float(used[worst]),
        )

    def _friction(self) -> Gauge:
        """The most used friction of a loaded foot, its force split along the ground's normal."""
        plant, up = self._simulation.plant, self._simulation.plant.ground.up
        used, side = _UNKNOWN, "no foot loaded"
        for i, truth in enumerate(plant.feet()):
            normal = float(truth.force.dot(up))
            if normal > LOADED_N * self._simulation.robot.sizes.weight:
                share = float(np.linalg.norm(truth.force - normal * up)) / (plant.physics.friction * normal)
                if not share <= used:
                    used, side = share, f"{self._simulation.robot.feet[i].side} foot"
        return Gauge(name="friction", label=side, value=100.0 * used, unit="%", used=used)


def _edge_name(normal: np.ndarray) -> str:
    ahead, left = float(normal[0]), float(normal[1])
    if abs(ahead) >= abs(left):
        return _EDGES[1] if ahead > 0.0 else _EDGES[0]
    return _EDGES[3] if left > 0.0 else _EDGES[2]


def _joint_name(name: str) -> str:
    return name.replace("_", " ")
