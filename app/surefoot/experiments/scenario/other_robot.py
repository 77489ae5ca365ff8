"""A scenario that was written for one robot, in proportion to another one."""

from collections.abc import Mapping
from typing import Any

from surefoot.experiments.scenario.proportions import proportions_of, scaled
from surefoot.experiments.scenario.uneven_ground import StonesUnderSteps


def in_proportion_to(table: Mapping[str, Any], robot: str) -> dict[str, Any]:
    """The table of a scenario for another robot.

    Steps, lifts and what is stepped over go with the leg, what lies below a sole with the sole (a stone where
    a footstep will be, ahead, with the leg), periods and heights of
    G with sqrt(h / g) and h, impulses with what moves the capture point by the same share of the sole. Times at which
    something happens, durations of pushes, angles, durations of runs and settings of controllers stay.

    Args:
        table: as a file says it; values of a wrong kind are left for the check of the scenario.
        robot: as scenarios name it.

    Raises:
        InvalidInput: either robot cannot be used.
    """
    before, after = proportions_of(table["robot"]), proportions_of(robot)
    leg, spread, time = (getattr(after, name) / getattr(before, name) for name in ("leg", "foot_spread", "time"))
    length, width = (getattr(after, name) / getattr(before, name) for name in ("sole_length", "sole_width"))
    axis = length if _table(table, "reference").get("axis") == "sagittal" else width
    ahead = leg if table.get("footsteps") else length
    ratios = {
        "": {"com_height_m": time**2, "drop_height_m": leg},
        "reference": {
            "amplitude_m": axis,
            "duration_s": time,
            "step_length_m": leg,
            "step_width_m": spread,
            "step_period_s": time,
            "lift_m": leg,
        },
        "footsteps": {"x_m": leg, "y_m": spread},
        "stones": {"x_m": ahead, "y_m": width, "height_m": width, "size_m": (length, width)},
        "stones_under_steps": {"height_m": leg, "size_m": width, "offset_x_m": length, "offset_y_m": width},
        "ledges": {"x_m": leg, "height_m": leg},
        "tiles": {"size_m": length, "amplitude_m": leg},
    }
    found = {**_scaled_entries(table, ratios[""]), "robot": robot}
    for name, said in (("reference", {}), ("stones_under_steps", {"size_m": StonesUnderSteps.size_m})):
        if isinstance(table.get(name), Mapping):
            found[name] = _scaled_entries({**said, **table[name]}, ratios[name])
    for name in ("footsteps", "stones", "ledges"):
        if isinstance(table.get(name), list):
            found[name] = [_scaled_entries(entry, ratios[name]) for entry in table[name]]
    if isinstance(table.get("pushes"), list):
        found["pushes"] = [
            _scaled_entries(push, {"impulse_ns": after.impulse(angle) / before.impulse(angle)})
            for push in table["pushes"]
            for angle in (_number(push, "direction_deg"),)
        ]
    ground = table.get("ground")
    if isinstance(ground, Mapping) and isinstance(ground.get("tiles"), Mapping):
        found["ground"] = {**ground, "tiles": _scaled_entries(ground["tiles"], ratios["tiles"])}
    return found


def _scaled_entries(table: Any, ratios: Mapping[str, Any]) -> Any:
    if not isinstance(table, Mapping):
        return table
    return {key: _times(value, ratios[key]) if key in ratios else value for key, value in table.items()}


def _times(value: Any, ratio: Any) -> Any:
    if isinstance(value, list) and isinstance(ratio, tuple):
        return [_times(one, by) for one, by in zip(value, ratio, strict=False)]
    return scaled(value, ratio) if isinstance(value, int | float) and not isinstance(value, bool) else value


def _table(table: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    return table[name] if isinstance(table.get(name), Mapping) else {}


def _number(table: Any, name: str) -> float:
    value = table.get(name, 0.0) if isinstance(table, Mapping) else 0.0
    return float(value) if isinstance(value, int | float) else 0.0
