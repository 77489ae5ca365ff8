"""Ground that is turned while the robot stands on it: from however it lies to another slope, about its pivot."""

import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.simulation.ground import Ground, GroundPose

PIVOT = np.array((0.0, 0.11, 0.0))


def slope_of(pose: GroundPose) -> tuple[float, float]:
    """Angle [deg], and where it rises to [deg]."""
    up = pose.up
    return float(np.rad2deg(np.arccos(up[2]))), float(np.rad2deg(np.arctan2(-up[1], -up[0])))


def test_it_turns_from_rest_to_rest_and_on_to_another_direction():
    pose = GroundPose(Ground(), PIVOT)
    pose.tilt(1.0, 4.0, 90.0, 0.5)
    angles = []
    for time_s in np.arange(0.9, 1.6, 0.01):
        pose.move(float(time_s))
        angles.append(slope_of(pose)[0])
    assert angles[0] == 0.0
    assert (np.diff(angles) >= -1e-12).all()
    assert slope_of(pose) == pytest.approx((4.0, 90.0), abs=1e-9)
    pose.tilt(2.0, 4.0, 0.0, 1.0)
    pose.move(2.0)
    assert slope_of(pose) == pytest.approx((4.0, 90.0), abs=1e-9)  # no jump
    pose.move(2.5)
    assert slope_of(pose)[1] == pytest.approx(45.0, abs=1e-6)
    assert pose.move(3.0)  # the same angle as at the start, another direction
    assert slope_of(pose) == pytest.approx((4.0, 0.0), abs=1e-9)
    assert not pose.move(4.0)
    np.testing.assert_allclose(pose.to_world(PIVOT), PIVOT, rtol=0, atol=1e-15)


def test_it_starts_from_a_scenarios_own_slope_and_can_be_levelled():
    pose = GroundPose(Ground(slope_deg=5.0, direction_deg=180.0), PIVOT)
    pose.move(0.0)
    pose.tilt(0.5, 0.0, 0.0, 0.2)
    pose.move(0.5)
    assert slope_of(pose)[0] == pytest.approx(5.0, abs=1e-9)
    pose.move(0.7)
    np.testing.assert_allclose(pose.rotation, np.eye(3), rtol=0, atol=1e-12)


def test_the_robot_stands_on_ground_that_turns_under_it(simulate):
    simulation = simulate(support="double")
    simulation.plant.ground.tilt(0.0, 3.0, 0.0, 0.3)
    for _ in range(1500):
        simulation.tick()
    assert simulation.fallen is None
    for foot in simulation.plant.feet():
        lean = np.rad2deg(np.arccos(foot.rotation[:, 2].dot(simulation.plant.ground.up)))
        assert lean < 0.3


@pytest.mark.parametrize(("slope", "duration"), [(45.0, 1.0), (3.0, 0.0), (float("nan"), 1.0), (3.0, 1e9)])
def test_what_makes_no_sense_is_refused(slope, duration):
    pose = GroundPose(Ground(), PIVOT)
    with pytest.raises(InvalidInput, match="valid"):
        pose.tilt(0.0, slope, 0.0, duration)
    assert pose.tilts == ()
