"""One cell: play level after level until the edge of survival is found; a row for every episode."""

import math
from collections.abc import Callable
from typing import Any

from surefoot.control.registry import controller_named
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import ControllerError, EstimatorError, InvalidInput, PostureError
from surefoot.experiments.bench.cells import Cell
from surefoot.experiments.bench.episode import Episode, play
from surefoot.experiments.bench.impulse_budget import momentum_ledger
from surefoot.experiments.scenario.bounds import push_bound, step_impulse, swing_excursion
from surefoot.experiments.scenario.references import start_posture
from surefoot.experiments.scenario.robots import without_folder
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.experiments.scenario.scenario_text import scenario_text
from surefoot.gait.emergency_step import landing_time, step_reach
from surefoot.gait.footsteps import step_limits
from surefoot.gait.scale import gait_scale
from surefoot.robot.description import RobotDescription
from surefoot.simulation.external_forces import WHOLE_ROBOT
from surefoot.simulation.falls import CONTROLLER_ERROR, ESTIMATOR_ERROR
from surefoot.task.posture import solve_posture

Row = dict[str, Any]
_NAN = math.nan
EXCEPTION = "exception"  # the cause of a fall that is a bug
OTHER_PLANT = "other_plant"  # a column of those runs alone whose plant is not the nominal robot: 1


def run_cell(cell: Cell) -> list[Row]:
    """All rows of a cell, weakest level first, each with the cell's threshold: the largest level survived.

    The threshold is 0 when not even the first level is survived, NaN when every level tried was refused. ``at_top``
    marks a threshold that may well be higher: the ladder ends there, or the next level cannot be started.
    """
    levels, rows = cell.case.levels, {}

    def survives(index: int) -> bool:
        if index not in rows:
            rows[index] = _row(cell, levels[index])
        return rows[index]["survived"]

    best = (every_level if cell.every_level else bisect_levels)(len(levels), survives)
    threshold = levels[best] if best >= 0 else 0.0
    refused = all(row["outcome"] == "refused" for row in rows.values())
    at_top = best == len(levels) - 1 or rows[best + 1]["outcome"] == "refused"
    for index, row in rows.items():
        row.update(threshold=_NAN if refused else threshold, at_threshold=index == best, at_top=at_top)
    return [rows[index] for index in sorted(rows)]


def _row(cell: Cell, level: float) -> Row:
    """Play one level."""
    table, row = cell.table_at(level), _empty_row(cell, level)
    command = f"surefoot run THIS_FILE --controller {cell.controller}"
    row["scenario"] = scenario_text(
        without_folder(table), f"{cell.case.family} {cell.case.name}, seed {cell.seed}\n{command}"
    )
    try:
        scenario = cell.scenario_at(level)
        row.update(_where(scenario), **_limits(cell, scenario))
        outside = solve_posture(DynamicsModel(scenario.robot_description()), start_posture(scenario)).out_of_range
        if outside:
            return {**row, "outcome": "refused", "refusal": f"the posture puts {outside[0]}"}
        nominal = not scenario.model_error.any  # else J_cap is not the bound of this plant, and no ledger adds up to it
        row.update({} if nominal else {OTHER_PLANT: 1.0})
        through_com = cell.case.unit == "J/J_cap"
        episode = play(scenario, cell.controller, keep_ground=nominal and through_com and level > 1.0)
    except (InvalidInput, PostureError) as error:
        return {**row, "outcome": "refused", "refusal": str(error)}
    except (ControllerError, EstimatorError) as error:
        cause = CONTROLLER_ERROR if isinstance(error, ControllerError) else ESTIMATOR_ERROR
        return {**row, "outcome": "falls", "fall_cause": cause, "refusal": str(error)}
    except Exception as error:  # a bug of ours; it must not end a bench of hours
        return {**row, "outcome": "falls", "fall_cause": EXCEPTION, "refusal": f"{type(error).__name__}: {error}"}
    row.update(_measured(episode), **_pushed_in_walk(episode, row["impulse_ns"], scenario.robot_description()))
    if episode.ground is not None and row["survived"]:
        push = scenario.pushes[0]
        ledger = momentum_ledger(episode.ground, push_bound(scenario), push.start_s, push.impulse_ns)
        row.update(
            excess_ns=ledger.excess_ns,
            angular_momentum_ns=ledger.angular_momentum_ns,
            sole_ns=ledger.sole_ns,
            foot_moved_ns=ledger.foot_moved_ns,
            vertical_ns=ledger.vertical_ns,
            ends_ns=ledger.ends_ns,
            ledger_gap_ns=ledger.gap_ns,
            unexplained_ns=ledger.unexplained_ns,
            explained=ledger.adds_up,
        )
    return row


def _empty_row(cell: Cell, level: float) -> Row:
    """Every column, so that all rows have the same: numbers NaN, texts empty where they mean nothing."""
    case = cell.case
    numbers = (
        "threshold",
        "com_error_m",
        "com_speed_mps",
        "swing_force_n",
        "fall_time_s",
        "first_limit_time_s",
        "zmp_margin_min_m",
        "infeasible_ticks",
        "amplitude_m",
        "swing_duration_s",
        "stone_x_m",
        "stone_y_m",
        "stone_height_m",
        "push_direction_deg",
        "impulse_ns",
        "slope_deg",
        "slope_direction_deg",
        "friction",
        "mass_scale",
        "control_delay_s",
        "eta",
        "bound_ns",
        "linear_ns",
        "reference_zmp_margin_m",
        "reference_capture_margin_m",
        "excess_ns",
        "angular_momentum_ns",
        "sole_ns",
        "foot_moved_ns",
        "vertical_ns",
        "ends_ns",
        "ledger_gap_ns",
        "unexplained_ns",
    )
    return {
        "family": case.family,
        "case": case.name,
        "controller": cell.label,
        "registry_name": cell.controller,
        "seed": cell.seed,
        "level": level,
        "unit": case.unit,
        "goal": _NAN if case.goal is None else case.goal,
        "outcome": "",
        "survived": False,
        "at_threshold": False,
        "at_top": False,
        "explained": True,
        **dict.fromkeys(numbers, _NAN),
        "support": "",
        "axis": "",
        "link": "",
        "fall_cause": "",
        "first_cause": "",
        "first_limit": "",
        "refusal": "",
        "scenario": "",
        "cell": cell.key,
    }


def _where(scenario: Scenario) -> Row:
    """Coordinates of the disturbance, for maps."""
    physics, ground = scenario.physics, scenario.ground
    row: Row = {
        "support": scenario.support.value,
        "friction": physics.friction,
        "mass_scale": physics.mass_scale,
        "control_delay_s": physics.control_delay_s,
    }
    if scenario.reference.kind == "swing":
        spec = scenario.reference
        row.update(axis=spec.axis, amplitude_m=spec.amplitude_m, swing_duration_s=spec.duration_s)
    for stone in scenario.stones[:1]:
        row.update(stone_x_m=stone.x_m, stone_y_m=stone.y_m, stone_height_m=stone.height_m)
    for push in scenario.pushes[:1]:
        row.update(link=push.link, push_direction_deg=push.direction_deg, impulse_ns=push.impulse_ns)
    if ground.slope_deg:
        row.update(slope_deg=ground.slope_deg, slope_direction_deg=ground.direction_deg)
    return row


def _limits(cell: Cell, scenario: Scenario) -> Row:
    """What physics allows: the capture bounds of a push on flat ground, the excursions of a swing."""
    if scenario.reference.kind == "swing":
        excursion = swing_excursion(scenario)
        return {
            "reference_zmp_margin_m": excursion.zmp_margin_m,
            "reference_capture_margin_m": excursion.capture_margin_m,
        }
    if cell.case.unit == "J/J_cap" and scenario.pushes[0].link == WHOLE_ROBOT:
        bound = push_bound(scenario)
        settings = controller_named(cell.controller).settings(scenario.controller)
        return {
            "eta": round(scenario.pushes[0].impulse_ns / bound.impulse_ns, 9),
            "bound_ns": bound.impulse_ns,
            "linear_ns": bound.linear_impulse_ns(settings),
        }
    if cell.case.unit == "J/J_cap1":
        bound, robot = step_impulse(scenario), scenario.robot_description()
        ahead, aside = step_reach(robot)
        return {
            "eta_1": round(scenario.pushes[0].impulse_ns / bound, 9),
            "bound_1_ns": bound,
            "step_ahead_m": ahead[1],
            "step_back_m": -ahead[0],
            "step_aside_m": aside[1],
            "step_landing_s": landing_time(robot),
        }
    return {}


def _measured(episode: Episode) -> Row:
    survival = episode.survival
    limit = episode.first_limit
    return {
        "outcome": survival.outcome,
        "survived": survival.outcome == "stands",
        "com_error_m": survival.com_error_m,
        "com_speed_mps": survival.com_speed_mps,
        "swing_force_n": survival.swing_force_n,
        "fall_cause": episode.fall_cause or "",
        "fall_time_s": _rounded(episode.fall_time_s),
        "first_cause": episode.first_cause.name if episode.first_cause else "",
        "first_limit": limit.name if limit else "",
        "first_limit_time_s": round(limit.time_s, 6) if limit else _NAN,
        "zmp_margin_min_m": episode.zmp_margin_min_m,
        "infeasible_ticks": float(episode.infeasible_ticks),
        "refusal": episode.error or "",
        **_walked(episode),
        **episode.belief,  # columns of those runs alone that have an estimator
        **({} if episode.stood_off_m is None else {"stood_off_m": episode.stood_off_m}),
    }


def _walked(episode: Episode) -> Row:
    """Columns that only those who step have."""
    if episode.steps_made is None or episode.steps_planned is None:
        return {}
    return {
        "steps_made": float(episode.steps_made),
        "steps_planned": float(episode.steps_planned),
        "first_cause_time_s": round(episode.first_cause.time_s, 6) if episode.first_cause else _NAN,
        "ankle_stop_s": _rounded(episode.ankle_stop_s),
        "ankle_stop_before_s": _rounded(episode.ankle_stop_before_s),
    }


def _pushed_in_walk(episode: Episode, impulse_ns: float, robot: RobotDescription) -> Row:
    """J_cap1 as a walk's push began, and what it is for."""
    bound = episode.walking_bound
    if bound is None:
        return {}
    ahead, aside = step_limits(gait_scale(robot))
    return {
        "eta_1": round(impulse_ns / bound.impulse_ns, 9) if bound.impulse_ns > 0.0 else _NAN,
        "bound_1_ns": bound.impulse_ns,
        "step_ahead_m": ahead[1],
        "step_back_m": -ahead[0],
        "step_aside_m": aside[1],
        "step_landing_s": bound.landing_s,
    }


def _rounded(time_s: float | None) -> float:
    return _NAN if time_s is None else round(time_s, 6)


def bisect_levels(count: int, survives: Callable[[int], bool]) -> int:
    """Index of the greatest level survived, -1 when there is none; assumes that what is weaker is survived too.

    Asks about log2(count + 1) times, so ladders of 7, 15 or 31 levels waste nothing.
    """
    low, high = -1, count
    while high - low > 1:
        middle = (low + high) // 2
        if survives(middle):
            low = middle
        else:
            high = middle
    return low


def every_level(count: int, survives: Callable[[int], bool]) -> int:
    """Index of the last level before the first that is not survived, -1 when there is none; asks about all of them."""
    answers = [survives(i) for i in range(count)]
    return answers.index(False) - 1 if False in answers else count - 1
