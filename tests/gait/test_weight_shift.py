"""How long the weight shifts: as planned when the capture point is where it should be, longer when it lags."""

import numpy as np
import pytest

from surefoot.gait.dcm_plan import DCMPlan, ZMPPiece
from surefoot.gait.weight_shift import LONGEST_S, shift_duration

OMEGA = 3.2
HERE, THERE, NEXT = np.array((0.0, -0.11)), np.array((0.2, 0.11)), np.array((0.4, -0.11))
THEN = [ZMPPiece(THERE, THERE, 0.6), ZMPPiece(THERE, NEXT, 0.15)]


def begins(duration_s: float) -> np.ndarray:
    """Where the plan has the capture point when a shift of that duration begins."""
    return DCMPlan([ZMPPiece(HERE, THERE, duration_s), *THEN], OMEGA).at(0.0)[1]


@pytest.mark.parametrize("lasts_s", [0.15, 0.25, 0.33, 0.45])
def test_it_takes_as_long_as_brings_the_capture_point_onto_the_plan(lasts_s):
    assert shift_duration(HERE, THEN, begins(lasts_s), OMEGA, 0.15) == pytest.approx(lasts_s, abs=0.011)


def test_it_is_never_shorter_than_planned_nor_longer_than_the_longest():
    ahead, behind = 2.0 * begins(0.15) - HERE, HERE + 0.1 * (HERE - THERE)
    assert shift_duration(HERE, THEN, ahead, OMEGA, 0.15) == 0.15
    assert shift_duration(HERE, THEN, behind, OMEGA, 0.15) == LONGEST_S
    assert shift_duration(HERE, THEN, behind, OMEGA, 0.8) == 0.8


def test_no_duration_that_was_tried_begins_nearer():
    random = np.random.default_rng(5)
    for _ in range(20):
        capture = begins(0.2) + random.normal(0.0, 0.03, 2)
        best = shift_duration(HERE, THEN, capture, OMEGA, 0.15)
        off = [np.linalg.norm(begins(d) - capture) for d in np.linspace(0.15, LONGEST_S, 16)]
        assert np.linalg.norm(begins(best) - capture) <= min(off) + 1e-3
