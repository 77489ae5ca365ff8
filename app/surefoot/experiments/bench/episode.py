"""One scenario played to its end or to the fall, with what the criterion and the momentum ledger need."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from surefoot.experiments.bench.ankle_stop import AnkleStopTally
from surefoot.experiments.bench.criteria import Survival, judge, judge_steps, judge_walk, stood_off
from surefoot.experiments.runs.belief_tally import BeliefTally
from surefoot.experiments.runs.walk_tally import WalkTally
from surefoot.experiments.scenario.bounds import WalkingBound, walking_bound
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.experiments.scenario.timing import first_onset
from surefoot.gait.progress import Phase
from surefoot.gait.step_when_needed import StepWhenNeeded
from surefoot.gait.walk import Walk
from surefoot.geometry.rotations import cross
from surefoot.robot.feet import Support
from surefoot.simulation.external_forces import WHOLE_ROBOT
from surefoot.simulation.falls import LimitEvent
from surefoot.simulation.loop import Simulation, TickResult
from surefoot.simulation.measurement import sole_outline
from surefoot.simulation.physics import TIMESTEP_S

LEARNS_S = 1.0  # so long what an estimator believes is not counted: it finds the biases of its sensors


@dataclass(frozen=True, eq=False)
class GroundHistory:
    """What the ground did to the whole robot, tick by tick.

    Attributes:
        time_s: (n,).
        com: CoM (n, 3) in world [m].
        com_velocity: (n, 3) [m/s].
        force: of the ground on both feet (n, 3) [N].
        moment_about_com: of the same about the CoM (n, 3) [N m]: the rate of angular momentum about G.
        zmp_load: vertical force times ZMP on the plane z = 0 (n, 2) [N m], from the feet's wrenches.
        sole_corners: of the stance feet where they are now, seen from above (n, corners, 2) [m].
    """

    time_s: np.ndarray
    com: np.ndarray
    com_velocity: np.ndarray
    force: np.ndarray
    moment_about_com: np.ndarray
    zmp_load: np.ndarray
    sole_corners: np.ndarray


@dataclass(frozen=True, eq=False)
class Episode:
    """How it went.

    Attributes:
        survival: survived or not, and by how much.
        fall_cause, fall_time_s: as in ``surefoot run``; None without a fall.
        first_limit: what went first, or None.
        zmp_margin_min_m: least margin of the measured ZMP; NaN when there was none.
        infeasible_ticks: ticks in which a QP had no solution.
        ground: the ground's history, when it was asked for.
        error: what a controller that failed did; else None.
        steps_made, steps_planned: of what steps, planned or when needed; else None.
        first_cause: what brought a walk down; None without a fall and of who does not walk.
        ankle_stop_s: how long an ankle of a loaded foot was at its stop in a walk [s]; else None.
        ankle_stop_before_s: the same in the last second before the first cause; None without a fall.
        walking_bound: J_cap1 as a walk's first push begins; None without one.
        belief: how wrong the estimator was from ``LEARNS_S`` on, see ``BeliefTally``; empty without one.
        stood_off_m: distance of the CoM from its reference while the robot stood before the disturbance; None where
            nothing disturbed it, and with the true state and the nominal model.
    """

    survival: Survival
    fall_cause: str | None
    fall_time_s: float | None
    first_limit: LimitEvent | None
    zmp_margin_min_m: float
    infeasible_ticks: int
    ground: GroundHistory | None
    error: str | None = None
    steps_made: int | None = None
    steps_planned: int | None = None
    first_cause: LimitEvent | None = None
    ankle_stop_s: float | None = None
    ankle_stop_before_s: float | None = None
    walking_bound: WalkingBound | None = None
    belief: Mapping[str, float] = field(default_factory=dict)
    stood_off_m: float | None = None


def play(scenario: Scenario, controller: str, *, keep_ground: bool = False) -> Episode:
    """Play a scenario, the same ticks as ``surefoot run``. Raises InvalidInput, PostureError, ControllerError."""
    ticks = scenario.ticks
    simulation = build_simulation(scenario, controller, rows=ticks).simulation
    walk = WalkTally(simulation.gait) if isinstance(simulation.gait, Walk) else None
    ankles, bound, believed = AnkleStopTally(simulation.robot), None, BeliefTally()
    margin, infeasible = np.inf, 0
    ground: list[np.ndarray] = []
    for _ in range(ticks):
        result = simulation.tick()
        if walk:
            walk.add(result)
        if result.fall_cause is not None or result.terms is None or result.output is None:
            break
        if result.terms.state.time_s >= LEARNS_S:
            believed.add(result.belief)
        margin = min(margin, result.balance.zmp_margin)  # keeps what it has when the other is NaN
        infeasible += result.output.infeasible
        if walk:
            ankles.add(result.terms, result.balance)
            bound = bound or _pushed(scenario, simulation, result)
        if keep_ground:
            com = result.terms.position_com_in_world
            ground.append(_ground_row(simulation, com, result.terms.velocity_com_in_world))
    survival, stood_off_m = _survival(scenario, simulation)
    came_to: dict[str, Any] = {}
    if walk:
        came_to = walk.summary(fell=simulation.fallen is not None)
        survival = judge_walk(survival, completed=came_to["walk_completed"])
        came_to["ankle_stop_s"] = ankles.time_s
        if simulation.fall_first is not None:
            came_to["ankle_stop_before_s"] = ankles.before(simulation.fall_first.time_s)
    elif isinstance(simulation.gait, StepWhenNeeded):
        progress = simulation.gait.progress
        came_to = {"steps_made": progress.made, "steps_planned": progress.planned}
        survival = judge_steps(survival, on_its_feet=progress.phase in (Phase.WAITING, Phase.STANDING))
    return Episode(
        survival,
        simulation.fallen,
        simulation.fall_time_s,
        simulation.watch.first,
        float(margin) if np.isfinite(margin) else float("nan"),
        infeasible,
        _history(ground) if ground else None,
        simulation.error,
        came_to.get("steps_made"),
        came_to.get("steps_planned"),
        simulation.fall_first,
        came_to.get("ankle_stop_s"),
        came_to.get("ankle_stop_before_s"),
        bound,
        believed.summary(),
        stood_off_m,
    )


def _pushed(scenario: Scenario, simulation: Simulation, result: TickResult) -> WalkingBound | None:
    """The bound of a walk's first push, in the first tick that it acts in."""
    watch, terms = simulation.walk_watch, result.terms
    if not scenario.pushes or watch is None or terms is None:
        return None
    push = scenario.pushes[0]
    if push.link != WHOLE_ROBOT or terms.state.time_s < push.start_s - 0.5 * TIMESTEP_S:
        return None
    mass_kg = simulation.robot.mass_kg * scenario.physics.mass_scale
    return walking_bound(watch, result, mass_kg, push.direction, push.duration_s)


def _ground_row(simulation: Simulation, com: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    force, moment, zmp_load = np.zeros(3), np.zeros(3), np.zeros(2)
    for foot in simulation.plant.feet():
        ankle = foot.position_ankle
        force += foot.force
        moment += foot.moment + cross(ankle - com, foot.force)
        zmp_load += foot.force[2] * ankle[:2] - ankle[2] * foot.force[:2] + (-foot.moment[1], foot.moment[0])
    feet = simulation.plant.feet()
    corners = [sole_outline(simulation.plant.built, feet[i], i).ravel() for i in simulation.support.stance]
    return np.concatenate(((simulation.time_s - TIMESTEP_S,), com, velocity, force, moment, zmp_load, *corners))


def _history(rows: list[np.ndarray]) -> GroundHistory:
    table = np.array(rows)
    return GroundHistory(
        table[:, 0],
        table[:, 1:4],
        table[:, 4:7],
        table[:, 7:10],
        table[:, 10:13],
        table[:, 13:15],
        table[:, 15:].reshape(len(table), -1, 2),
    )


def _survival(scenario: Scenario, simulation: Simulation) -> tuple[Survival, float | None]:
    """How it ended, and how far from its reference it had stood before, where it does not know everything."""
    columns = simulation.recorder.columns
    table = simulation.recorder.table()
    if not len(table):
        return Survival("falls", float("nan"), float("nan"), float("nan")), None
    com, wanted, velocity = (
        table[:, [columns.index(f"{name}_{axis}_{unit}") for axis in "xyz"]]
        for name, unit in (("com", "m"), ("com_ref", "m"), ("com_velocity", "mps"))
    )
    time_s, off, stood = table[:, columns.index("time_s")], com - wanted, None
    if simulation.senses is not None or scenario.model_error.any:
        place = stood_off(time_s, off, first_onset(scenario))
        if place is not None:
            off, stood = off - place, float(np.linalg.norm(place))
    swing = np.zeros(len(table))
    if simulation.support is not Support.DOUBLE:
        name = ("force_left_n", "force_right_n")[1 - simulation.support.reference_foot]
        swing = table[:, columns.index(name)]
    survival = judge(
        fell=simulation.fallen is not None,
        time_s=time_s,
        com_error_m=np.linalg.norm(off, axis=1),
        com_speed_mps=np.linalg.norm(velocity, axis=1),
        swing_force_n=swing,
    )
    return survival, stood
