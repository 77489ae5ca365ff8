"""How large each push of a run was, against what can be survived without a step."""

from typing import Any

from surefoot.experiments.scenario.bounds import push_bound
from surefoot.experiments.scenario.scenario import Scenario


def push_shares(scenario: Scenario) -> list[dict[str, Any]]:
    """Every push of a scenario as ``surefoot run --json`` has it: J [N s], J_cap [N s] and eta = J / J_cap.

    J_cap is the bench's (``push_bound``): for the push's duration, from the CoM at rest above the soles at the start,
    the robot being its model and the push going through the CoM, wherever it acts. ``eta`` is None where J_cap is not
    above 0. Empty for a swing or a walk: whoever pushes there meets a CoM that moves, and from rest says nothing of it.
    """
    if scenario.reference.kind != "hold":
        return []
    bounds = [push_bound(scenario, push).impulse_ns for push in scenario.pushes]
    return [
        {
            "start_s": push.start_s,
            "direction_deg": push.direction_deg,
            "link": push.link,
            "impulse_ns": push.impulse_ns,
            "bound_ns": bound,
            "eta": push.impulse_ns / bound if bound > 0.0 else None,
        }
        for push, bound in zip(scenario.pushes, bounds, strict=True)
    ]
