"""From the living simulation to an immutable picture of it. Called by the session's thread only."""

from collections import deque
from typing import Any

import numpy as np

from surefoot.control.interface import STATUS_HELP
from surefoot.dashboard.live.observation.footprints import footprints
from surefoot.dashboard.live.observation.limit_monitor import LimitMonitor
from surefoot.dashboard.live.observation.plot_rows import TRACE_EVERY_TICKS, TraceLog, trace_row
from surefoot.dashboard.messages.believed import BelievedRobot, soles_of
from surefoot.dashboard.messages.limits import LimitMargins
from surefoot.dashboard.messages.signals import TRACE_COLUMNS
from surefoot.dashboard.messages.snapshot import LOADED_N, BalanceStatus, Geometry, PlotLimits
from surefoot.dashboard.messages.stone_view import stone_views
from surefoot.gait.dcm_plan import NO_PLAN
from surefoot.geometry.polygon import convex_hull
from surefoot.robot.description import Joint
from surefoot.simulation.conventions import qpos_from_q
from surefoot.simulation.event_texts import fall_text
from surefoot.simulation.loop import Simulation, TickResult
from surefoot.simulation.measurement import contact_forces, measure_balance
from surefoot.simulation.plant import FootTruth

_TABLE_EVERY_TICKS = 66
_PLAN_EVERY_TICKS = 50  # as long as a snapshot's other half to make, and drawn no oftener
_TRAIL_EVERY_TICKS = 30
_TRAIL_ROWS = 40  # 1.2 s
_NOWHERE = np.full(2, np.nan)


class Observer:
    """Remembers the recent past of one run and takes pictures of the present.

    Args:
        simulation: what to look at.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._last: TickResult | None = None
        self._ticks = 0
        self._traces = TraceLog()
        self._headroom = LimitMonitor(simulation)
        self._table = np.empty((0, len(TRACE_COLUMNS)))
        self._table_at = -1
        self._planned, self._planned_at = NO_PLAN, -1
        self._shown: Geometry | None = None
        self._trail: deque[tuple[float, ...]] = deque(maxlen=_TRAIL_ROWS)
        self.limits = _plot_limits(simulation)

    def look(self, result: TickResult) -> None:
        """Remember one tick."""
        self._last = result
        if result.output is None:  # no time has gone by
            return
        self._headroom.look(result)
        if self._ticks % TRACE_EVERY_TICKS == 0:
            self._traces.add(trace_row(self._simulation, result))
        com = result.position_com
        if self._ticks % _TRAIL_EVERY_TICKS == 0 and com is not None:
            self._trail.append((*result.balance.zmp_in_world, *com[:2], *result.capture))
        self._ticks += 1

    def traces(self) -> np.ndarray:
        """Rows for the plots, oldest first; made again every fifteenth of a second of simulated time at most."""
        if self._ticks // _TABLE_EVERY_TICKS != self._table_at:
            self._table, self._table_at = self._traces.table(), self._ticks // _TABLE_EVERY_TICKS
        return self._table

    def headroom(self) -> LimitMargins:
        """How far away each limit is now."""
        return self._headroom.view(self._last)

    def save_state(self) -> tuple[Any, ...]:
        """What is remembered now, for ``restore_state``."""
        return self._last, self._ticks, self._traces.copy(), self._trail.copy(), self._headroom.save_state()

    def restore_state(self, kept: tuple[Any, ...]) -> None:
        """Remember what was remembered then."""
        self._last, self._ticks, traces, trail, limits = kept
        self._traces, self._trail = traces.copy(), trail.copy()
        self._headroom.restore_state(limits)
        self._table, self._table_at = np.empty((0, len(TRACE_COLUMNS))), -1
        self._planned_at = -1

    def geometry(self) -> Geometry:
        """Where everything is now; where that is no number any more, where it was last seen."""
        simulation, last = self._simulation, self._last
        plant = simulation.plant
        if self._shown is not None and not plant.is_finite():
            return self._shown
        feet = plant.feet()
        soles = np.stack([_sole(simulation, i, foot) for i, foot in enumerate(feet)])
        balance = last.balance if last else measure_balance(plant.built, feet, simulation.support)
        com = plant.position_com()
        output = last.output if last else None
        self._shown = Geometry(
            qpos=plant.data.qpos.copy(),
            com=com,
            ground_rotation=plant.ground.rotation.copy(),
            ground_pivot=plant.ground.pivot.copy(),
            support_origin=balance.origin if np.isfinite(balance.origin).all() else plant.ground.pivot.copy(),
            zmp_measured=balance.zmp_in_world,
            zmp_commanded=output.zmp_commanded_in_world if output else _NOWHERE,
            capture=last.capture if last else com[:2],
            soles=soles,
            footprints=footprints(simulation, feet),
            plan_ahead=self._plan_ahead(),
            standing=simulation.gait.standing if simulation.gait else simulation.support.stance,
            support_polygon=_loaded_hull(soles, feet, LOADED_N * simulation.robot.sizes.weight),
            contacts=contact_forces(plant),
            stones=stone_views(plant.stones.placed, simulation.time_s, plant.ground),
            trail=np.array(self._trail) if self._trail else np.empty((0, 6)),
            pulls=self._pulls(),
            believed=self._believed(),
        )
        return self._shown

    def _plan_ahead(self) -> np.ndarray:
        gait, at = self._simulation.gait, self._ticks // _PLAN_EVERY_TICKS
        if gait is None or self._simulation.fallen is not None:
            return NO_PLAN
        if at != self._planned_at:
            self._planned, self._planned_at = gait.plan_ahead, at
        return self._planned

    def _believed(self) -> BelievedRobot | None:
        """As of the last tick."""
        belief = self._last.belief if self._last else None
        if belief is None:
            return None
        return BelievedRobot(
            qpos=qpos_from_q(belief.terms.state.q),
            com=belief.position_com,
            capture=belief.capture,
            soles=soles_of(self._simulation.robot, belief.terms.feet),
        )

    def balance_status(self, *, ended: bool) -> BalanceStatus:
        """How the balance is doing now."""
        simulation, last = self._simulation, self._last
        limit = simulation.watch.first if simulation.fallen else None
        fall: dict[str, Any] = {
            "first_limit": limit.name if limit else None,
            "first_limit_s": limit.time_s if limit else None,
            "fall_cause": simulation.fallen,
            "fall_time_s": simulation.fall_time_s,
            "ended": ended,
            "fall_text": fall_text(simulation) if simulation.fallen else "",
        }
        if last is None or last.output is None:
            return BalanceStatus(torques_nm=np.zeros(len(simulation.robot.joints)), **fall)
        output = last.output
        return BalanceStatus(
            status=output.status.value,
            status_help=STATUS_HELP[output.status],
            guard_active=output.guard_active,
            guard_relaxed=output.guard_relaxed,
            gate_active=output.gate_active,
            infeasible=output.infeasible,
            zmp_margin_m=last.balance.zmp_margin,
            foot_forces_n=last.balance.normal_forces,
            torques_nm=last.applied,
            **fall,
        )

    def _pulls(self) -> np.ndarray:
        rows = []
        for pull in self._simulation.active_pulls():
            point, velocity = self._simulation.plant.held_point(pull)
            rows.append((*point, *pull.target, *pull.force(point, velocity)))
        return np.array(rows) if rows else np.empty((0, 9))


def _sole(simulation: Simulation, foot: int, truth: FootTruth) -> np.ndarray:
    return truth.position_ankle + simulation.plant.built.feet[foot].corners_from_ankle.dot(truth.rotation.T)


def _loaded_hull(soles: np.ndarray, feet: tuple[FootTruth, FootTruth], loaded_n: float) -> np.ndarray:
    """Hull, seen from above, of the soles that carry more than a force [N], each corner at its own height."""
    loaded = [sole for sole, foot in zip(soles, feet, strict=True) if foot.force[2] > loaded_n]
    if not loaded:
        return np.empty((0, 3))
    corners = np.vstack(loaded)
    if not np.isfinite(corners).all():
        return np.empty((0, 3))
    hull = convex_hull(corners[:, :2].tolist()).vertices
    nearest = ((hull[:, None, :] - corners[None, :, :2]) ** 2).sum(axis=2).argmin(axis=1)
    return corners[nearest]


def _plot_limits(simulation: Simulation) -> PlotLimits:
    """Edges of the support straight beside, before and behind its origin, as the robot stands now."""
    robot, support, feet = simulation.plant.built, simulation.support, simulation.plant.feet()
    origin = measure_balance(robot, feet, support).origin[:2]
    corners = np.vstack([_sole(simulation, i, feet[i]) for i in support.stance])[:, :2]
    polygon = convex_hull((corners - origin).tolist())
    reach = [
        1e3 * polygon.distance_to_edge(np.zeros(2), np.array(direction))
        for direction in ((-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0))
    ]
    foot = robot.feet[support.reference_foot]
    joints = {joint.dof: joint for joint in robot.joints}
    frontal, sagittal = joints[foot.frontal], joints[foot.sagittal]
    return PlotLimits(
        sagittal_mm=(-reach[0], reach[1]),
        lateral_mm=(-reach[2], reach[3]),
        ankle_frontal_nm=frontal.torque_limit_nm,
        ankle_sagittal_nm=sagittal.torque_limit_nm,
        ankle_frontal=_torque_symbol(frontal),
        ankle_sagittal=_torque_symbol(sagittal),
    )


def _torque_symbol(joint: Joint) -> str:
    """The paper's, where the joint has a number there."""
    return joint.name if joint.number is None else f"Γ{joint.number}"
