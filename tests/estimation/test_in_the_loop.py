"""Standing on what is believed: the whole loop with sensors of the preset ``robot``."""

import numpy as np
import pytest

from surefoot.geometry.rotations import rotation_vector

OURS = ("anchor", "invariant-ekf")
NOISY = {"sensors": {"preset": "robot", "seed": 11}}
RISING = {
    "x_m": 0.05,
    "y_m": 0.07,
    "height_m": 0.01,
    "size_m": [0.06, 0.05],
    "rise_start_s": 0.1,
    "rise_duration_s": 0.3,
}


@pytest.mark.parametrize("name", OURS)
def test_it_stands_on_one_foot_and_knows_its_capture_point(simulate, name):
    simulation = simulate(**NOISY, estimator={"kind": name})
    off = [np.hypot(*simulation.tick().belief.dcm_error) for _ in range(400)]
    assert simulation.fallen is None
    assert max(off) < 15e-3
    assert 1e-5 < np.median(off[300:]) < 5e-3  # the biases are known better by then


@pytest.mark.parametrize("name", OURS)
def test_a_stone_turns_the_sole_and_not_what_is_believed_of_the_tilt(simulate, name):
    simulation = simulate(**NOISY, estimator={"kind": name}, stones=[RISING])
    before = simulation.plant.feet()[0].rotation.copy()
    tilts = []
    for _ in range(700):
        tilts.append(np.hypot(*simulation.tick().belief.orientation_error[:2]))
    turned = np.linalg.norm(rotation_vector(simulation.plant.feet()[0].rotation @ before.T))
    assert simulation.fallen is None
    assert turned > 0.04
    assert max(tilts) < 0.1 * turned


@pytest.mark.parametrize("name", OURS)
def test_the_error_of_the_capture_point_is_what_its_band_says(simulate, name):
    """Seen from the feet, also far from where the run began: the band is not that of the place, which drifts."""
    simulation = simulate(**NOISY, estimator={"kind": name}, support="double")
    beliefs = [simulation.tick().belief for _ in range(1500)]
    errors, sigmas = (np.array([getattr(b, part) for b in beliefs]) for part in ("dcm_error", "dcm_sigma"))
    inside = (np.abs(errors) <= 3.0 * sigmas).mean(axis=0)
    ratio = np.sqrt((errors**2).mean(axis=0)) / np.sqrt((sigmas**2).mean(axis=0))
    assert (inside >= 0.9).all()
    assert (ratio > 0.2).all()
    assert (ratio < 2.0).all()
