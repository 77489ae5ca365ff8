"""How far a swing's reference asks the ZMP and the capture point to go, before anything moves."""

import math
from dataclasses import dataclass

import numpy as np

from surefoot.dynamics.terms import COM
from surefoot.errors import PostureError
from surefoot.experiments.bench.bounds import support_polygon_at_rest
from surefoot.experiments.scenario.references import plan_scenario, start_posture, unplanned_reference
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.momentum.capture import capture_point, natural_frequency

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
