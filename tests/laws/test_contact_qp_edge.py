"""Law of (17), hard form: infeasible exactly where the ZMP asked for leaves the sole, or the force its cone."""

import numpy as np
import pytest

from surefoot.control.balance.contact_wrench import required_wrench
from surefoot.control.qp.contact_qp import contact_model, force_qp
from surefoot.control.qp.solver import solve_qp
from surefoot.control.task_acceleration import acceleration_response
from surefoot.momentum.delta import momentum_rate
from surefoot.robot.feet import Support

# DAQP takes violations below 1e-6: in body weights about a foot of 0.1 m that is 1e-6 m of ZMP at most; bisection is
# finer still. A tenth of a millimetre is a hundred times that.
EDGE_M = 1e-4
DIRECTIONS = {"forward": 0.0, "back": 180.0, "left": 90.0, "right": -90.0, "diagonal": 45.0, "other diagonal": -120.0}


@pytest.fixture
def hard_qp(robot, standing, on_its_feet):
    """Support -> function of (CoM acceleration (3,), friction) that tells (feasible, ZMP margin, force)."""

    def for_support(support: Support):
        terms = standing(support)
        geometry, _ = on_its_feet(terms, support)

        def ask(com_acceleration: np.ndarray, friction: float = 0.9) -> tuple[bool, float, np.ndarray]:
            command = np.r_[com_acceleration, np.zeros(18)]
            acceleration = acceleration_response(terms, command).acceleration
            wrench = required_wrench(terms, momentum_rate(terms, acceleration), geometry)
            contacts = contact_model(robot, terms, geometry, corner_scale=1.0, friction=friction)
            feasible = solve_qp(force_qp(terms, acceleration, contacts), "daqp").x is not None
            return feasible, geometry.polygon.signed_margin(wrench.zmp), wrench.force

        return ask

    return for_support


def last_feasible(ask, direction: np.ndarray, **options) -> tuple[float, float, np.ndarray]:
    """Bisect the size of the acceleration: the size at the flip, and there the margin and the force."""
    assert ask(0.0 * direction, **options)[0]
    low, high = 0.0, 20.0
    assert not ask(high * direction, **options)[0]
    while high - low > 1e-7:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ask(middle * direction, **options)[0] else (low, middle)
    return low, *ask(low * direction, **options)[1:]


@pytest.mark.parametrize("support", Support)
@pytest.mark.parametrize("angle_deg", DIRECTIONS.values(), ids=DIRECTIONS.keys())
def test_turns_infeasible_where_the_zmp_crosses_the_edge_of_the_true_sole(hard_qp, support, angle_deg):
    direction = np.array((np.cos(np.deg2rad(angle_deg)), np.sin(np.deg2rad(angle_deg)), 0.0))
    size, margin, _ = last_feasible(hard_qp(support), direction)
    assert 0.1 < size < 10.0
    assert abs(margin) < EDGE_M


@pytest.mark.parametrize("axis", [0, 1], ids=["forward", "left"])
def test_sweep_through_the_edge_is_feasible_inside_and_only_there(hard_qp, axis):
    """No islands: along a sweep of the commanded acceleration feasibility is the sign of the margin, at every step."""
    ask = hard_qp(Support.LEFT)
    verdicts = []
    for size in np.linspace(-2.5, 2.5, 101):
        feasible, margin, _ = ask(size * np.eye(3)[axis])
        if abs(margin) > EDGE_M:
            assert feasible == (margin > 0.0)
        verdicts.append(feasible)
    assert np.count_nonzero(np.diff(verdicts)) == 2  # out, in, out


def test_turns_infeasible_where_the_force_leaves_the_friction_pyramid(hard_qp):
    """With little friction the cone is met before the edge: |F_x| = mu F_z."""
    friction = 0.05
    _, margin, force = last_feasible(hard_qp(Support.DOUBLE), np.array((-1.0, 0.0, 0.0)), friction=friction)
    assert margin > 0.01
    assert abs(force[0]) / force[2] == pytest.approx(friction, abs=1e-4)


@pytest.mark.parametrize(("downwards", "feasible"), [(0.0, True), (9.80, True), (9.82, False), (60.0, False)])
def test_the_ground_cannot_pull(robot, standing, on_its_feet, downwards, feasible):
    """The whole robot accelerates downwards as one body: beyond g the ZMP stays where it is, but none can pull."""
    terms = standing(Support.DOUBLE)
    fall = terms.rotation_pelvis_to_world.T @ np.array((0.0, 0.0, -downwards))
    acceleration = np.r_[fall, np.zeros(18)]
    geometry, _ = on_its_feet(terms, Support.DOUBLE)
    wrench = required_wrench(terms, momentum_rate(terms, acceleration), geometry)
    assert geometry.polygon.signed_margin(wrench.zmp) == pytest.approx(0.14, abs=EDGE_M)
    contacts = contact_model(robot, terms, geometry, corner_scale=1.0, friction=0.9)
    assert (solve_qp(force_qp(terms, acceleration, contacts), "daqp").x is not None) == feasible
