"""When the hard QP must become infeasible, read off the reference alone before anything is simulated.

The planner gives the ZMP of the reference's own motion, delta_P of the whole body included. From the tick at which it
leaves the sole, or the ground force the friction pyramid, no contact forces carry the motion.
"""

from dataclasses import dataclass

import numpy as np

from surefoot.control.balance_plan import plan_balance
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.model import DynamicsModel
from surefoot.experiments.scenario.references import start_posture, unplanned_reference
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.momentum.zmp import natural_frequency
from surefoot.robot.feet import Support
from surefoot.simulation.physics import TIMESTEP_S

_AROUND_S = 0.1  # how long before and after the swing is looked at


@dataclass(frozen=True, eq=False)
class Prediction:
    """What a reference's own motion needs of the ground, tick by tick.

    Attributes:
        time_s: (n,) the ticks of the simulation.
        zmp_in_world: (n, 2) [m].
        margin: (n,) signed distance of it to the edge of the sole [m].
        delta: (n, 3) delta_P of the reference [N m], world axes.
        friction_used: (n,) max(|F_x|, |F_y|) / F_z.
        point_mass_margin: (n,) the margin by the cart-table model, which knows no angular momentum about G [m].
        infeasible_s: first tick that no contact forces carry, or None.
        limit: what goes first: toe, heel, outer, inner (an edge) or friction.
        point_mass_infeasible_s: the same by the cart-table model.
    """

    time_s: np.ndarray
    zmp_in_world: np.ndarray
    margin: np.ndarray
    delta: np.ndarray
    friction_used: np.ndarray
    point_mass_margin: np.ndarray
    infeasible_s: float | None
    limit: str | None
    point_mass_infeasible_s: float | None


def predict(scenario: Scenario) -> Prediction:
    """Walk along a swing on one foot, from a little before it to a little after.

    Raises:
        ValueError: the scenario does not swing, or stands on both feet.
        PostureError: the reference leaves what inverse kinematics can reach.
    """
    swing, robot = scenario.reference, scenario.robot_description()
    if swing.kind != "swing" or scenario.support is Support.DOUBLE:
        raise ValueError(f"{scenario.name}: only a swing on one foot can be predicted")
    foot = robot.feet[scenario.support.reference_foot]
    posture = start_posture(scenario)
    reference = unplanned_reference(swing, posture)
    first = max(0, round((swing.start_s - _AROUND_S) / TIMESTEP_S))
    last = round((swing.start_s + swing.duration_s + _AROUND_S) / TIMESTEP_S)
    times = (np.arange(first, last + 1) * TIMESTEP_S).round(9)
    plan = plan_balance(DynamicsModel(robot), reference, times)

    com = np.array([reference.at(time).position_com for time in times.tolist()])
    acceleration = np.array([reference.at(time).acceleration[:3] for time in times.tolist()])
    omega = natural_frequency(float(com[0, 2]), robot.gravity)
    point_mass = com[:, :2] - acceleration[:, :2] / omega**2
    place = posture.position_ankles[scenario.support.reference_foot][:2]
    point_mass_margin = np.array([foot.sole.signed_margin(zmp - place) for zmp in point_mass])
    friction_used = np.abs(acceleration[:, :2]).max(axis=1) / (robot.gravity + acceleration[:, 2])

    slips = _first(times, friction_used > ControllerSettings().assumed_friction)
    leaves, limit = (plan.exit.time_s, plan.exit.edge) if plan.exit else (None, None)
    if slips is not None and (leaves is None or slips < leaves):
        leaves, limit = slips, "friction"
    return Prediction(
        times,
        plan.zmp_in_world,
        plan.margin_m,
        plan.delta_p_in_world,
        friction_used,
        point_mass_margin,
        leaves,
        limit,
        _first(times, point_mass_margin < 0.0),
    )


def _first(times: np.ndarray, passed: np.ndarray) -> float | None:
    where = np.flatnonzero(passed)
    return float(times[where[0]]) if len(where) else None
