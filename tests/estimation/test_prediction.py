"""A belief carried forward over the latency of its readings, and one that begins with a wrong tilt."""

import numpy as np
import pytest

from surefoot.estimation.prediction import Prediction
from surefoot.geometry.rotations import rotation_from_vector, rotation_from_xyzw

OURS = ("anchor", "invariant-ekf")
LATE = {"imu_latency_s": 0.005, "encoder_latency_s": 0.005, "foot_latency_s": 0.005}
PUSHED = {"pushes": [{"link": "trunk", "impulse_ns": 6.0, "direction_deg": 40.0, "start_s": 0.05, "duration_s": 0.05}]}


def test_everything_goes_on_as_fast_as_it_was(random_state):
    state = random_state(3)
    ahead = Prediction(0.004, 0.007).ahead(state)
    R, moved = rotation_from_xyzw(state.q[3:7]), rotation_from_xyzw(ahead.q[3:7])
    assert np.allclose(ahead.q[:3] - state.q[:3], 0.004 * R @ state.v[:3], rtol=0.0, atol=1e-12)
    assert np.allclose(moved, rotation_from_vector(0.004 * R @ state.v[3:6]) @ R, rtol=0.0, atol=1e-12)
    assert np.allclose(moved @ ahead.v[:3], R @ state.v[:3], rtol=0.0, atol=1e-12)
    assert np.array_equal(ahead.q[7:], state.q[7:] + 0.007 * state.v[6:])
    assert np.array_equal(ahead.v[3:], state.v[3:])
    assert ahead.time_s == state.time_s


@pytest.mark.parametrize("name", OURS)
def test_late_readings_leave_a_smaller_error_when_they_are_carried_forward(simulate, name):
    """All is perfect but late, and a push moves the robot: what the joints are off by is their motion since."""

    def joint_error(predict):
        simulation = simulate(sensors=LATE, estimator={"kind": name, "predict": predict}, **PUSHED)
        off = []
        for _ in range(250):
            true = simulation.plant.sense()[0].q
            off.append(simulation.tick().belief.terms.state.q[7:] - true[7:])
        assert simulation.fallen is None
        return np.sqrt(np.mean(np.square(off)))

    late, predicted = joint_error(False), joint_error(True)
    assert late > 1e-5
    assert predicted < 0.5 * late


def test_without_latency_nothing_is_carried_forward(simulate):
    plain, predicting = (simulate(estimator={"kind": "anchor", "predict": on}) for on in (False, True))
    for _ in range(30):
        assert plain.tick().applied.tobytes() == predicting.tick().applied.tobytes()


@pytest.mark.parametrize("seed", [1, 2])
def test_a_tilt_that_is_told_wrong_is_believed_at_first(simulate, seed):
    """What is told is turned from the truth by the draw, so that the truth is turned back from what is believed."""
    estimator = {"kind": "anchor", "told_tilt_rad": 0.004}
    wrong, right = (simulate(sensors={"seed": seed}, estimator=each) for each in (estimator, {"kind": "anchor"}))
    drawn = 0.004 * np.random.default_rng((seed, 4)).standard_normal(2)
    assert np.allclose(wrong.tick().belief.orientation_error[:2], -drawn, rtol=0.0, atol=1e-4)
    assert np.abs(right.tick().belief.orientation_error[:2]).max() < 1e-6
