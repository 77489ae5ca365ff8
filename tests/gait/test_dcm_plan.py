"""ZMP and capture point of the steps ahead, against a pendulum that is integrated."""

import numpy as np
import pytest

from surefoot.gait.dcm_plan import DCMPlan, ZMPPiece

OMEGA = 3.2
STEP_S = 1e-4


def at(x, y):
    return np.array((x, y))


@pytest.fixture
def plan():
    left, right, middle = at(0.0, 0.1), at(0.2, -0.1), at(0.3, 0.0)
    return DCMPlan(
        [
            ZMPPiece(at(0.0, 0.0), left, 0.3),
            ZMPPiece(left, left, 0.6),
            ZMPPiece(left, right, 0.15),
            ZMPPiece(right, right, 0.6),
            ZMPPiece(right, middle, 0.2),
        ],
        OMEGA,
    )


def test_a_pendulum_that_starts_on_the_plan_and_is_given_its_zmp_stays_on_it(plan):
    xi = plan.at(0.0)[1]
    for k in range(round(1.85 / STEP_S)):  # xi' = omega (xi - p), by the midpoint rule
        zmp = plan.at((k + 0.5) * STEP_S)[0]
        half = xi + 0.5 * STEP_S * OMEGA * (xi - plan.at(k * STEP_S)[0])
        xi = xi + STEP_S * OMEGA * (half - zmp)
        if k % 1000 == 0:
            assert xi == pytest.approx(plan.at((k + 1) * STEP_S)[1], abs=1e-4)
    assert xi == pytest.approx(at(0.3, 0.0), abs=1e-3)


def test_both_are_continuous_and_rest_at_the_end(plan):
    for edge in (0.3, 0.9, 1.05, 1.65, 1.85):
        before, after = plan.at(edge - 1e-9), plan.at(edge + 1e-9)
        assert np.concatenate(before) == pytest.approx(np.concatenate(after), abs=1e-7)
    zmp, xi = plan.at(5.0)
    assert zmp == pytest.approx(at(0.3, 0.0))
    assert xi == pytest.approx(at(0.3, 0.0))


def test_the_capture_point_is_ahead_of_the_zmp_towards_the_next_step(plan):
    zmp, xi = plan.at(1.0)  # on the way from left to right, forward
    assert xi[0] > zmp[0]
    assert xi[1] < plan.at(0.9)[1][1]


@pytest.mark.parametrize("since", [-0.1, 0.0, 0.2, 0.5, 0.95, 1.7])
def test_what_is_ahead_is_on_the_plan_from_now_to_its_end(plan, since):
    ahead = plan.ahead(since)
    assert ahead[0] == pytest.approx(np.concatenate(plan.at(max(since, 0.0))), abs=1e-12)
    assert ahead[-1] == pytest.approx(np.concatenate(plan.at(1.85)), abs=1e-9)
    past = np.array([np.concatenate(plan.at(t)) for t in np.arange(max(since, 0.0), 1.85, 1e-3)])
    for row in past:  # and leaves no corner out
        for point in (0, 2):
            assert distance_to_path(row[point : point + 2], ahead[:, point : point + 2]) < 2e-3
    for row in ahead:
        assert np.abs(past - row).max(axis=1).min() < 2e-3


def test_nothing_but_its_rest_is_ahead_of_a_plan_that_is_over(plan):
    assert plan.ahead(9.0) == pytest.approx(np.array([[0.3, 0.0, 0.3, 0.0]]))


def distance_to_path(point, path):
    along = np.diff(path, axis=0)
    part = ((point - path[:-1]) * along).sum(axis=1) / np.maximum((along * along).sum(axis=1), 1e-18)
    nearest = path[:-1] + np.clip(part, 0.0, 1.0)[:, None] * along
    return np.linalg.norm(nearest - point, axis=1).min()


def test_while_a_foot_is_late_the_pendulum_goes_on_over_the_sole_that_stands(plan):
    late_s, brake = 0.9, np.array((0.05, 0.02))  # from where the ZMP would begin to cross
    before, xi, nominal = plan.at(0.7), plan.at(late_s)[1], plan.at(late_s + 0.2)
    to_its_end = plan.ahead(0.7)
    plan.wait(late_s, brake)
    np.testing.assert_array_equal(plan.at(0.7), before)
    np.testing.assert_array_equal(plan.ahead(0.7), to_its_end)
    for _ in range(round(0.2 / STEP_S)):  # xi' = omega (xi - p), by the midpoint rule
        half = xi + 0.5 * STEP_S * OMEGA * (xi - brake)
        xi = xi + STEP_S * OMEGA * (half - brake)
    waits = plan.at(late_s + 0.2)
    assert waits[0] == pytest.approx(brake)
    assert waits[1] == pytest.approx(xi, abs=1e-6)
    assert waits[1][1] < nominal[1][1] - 0.01  # further to the foot that is late than the plan has it
    path = plan.ahead(late_s + 0.1)
    assert path[:, :2] == pytest.approx(np.tile(brake, (len(path), 1)))
    assert path[0] == pytest.approx(np.concatenate(plan.at(late_s + 0.1)))
    assert path[-1, 2:] == pytest.approx(brake + np.exp(OMEGA * 0.2) * (path[0, 2:] - brake))
