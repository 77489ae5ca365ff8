"""A point that follows the robot: not its swaying, and at once when it was put elsewhere."""

import numpy as np
import pytest

from surefoot.dashboard.scene.leash import Leash

SHORT_M = 0.2


def walked(leash, *places):
    for place in places:
        leash.follow(np.array(place))
    return leash.point


def test_swaying_moves_nothing_and_walking_leads_it_a_leash_behind():
    leash = Leash(SHORT_M)
    angle = np.linspace(0.0, 6.0, 40)
    swaying = 0.19 * np.column_stack((np.cos(angle), np.sin(angle)))
    assert not walked(leash, *swaying).any()
    assert walked(leash, (0.6, 0.0)) == pytest.approx((0.4, 0.0))
    assert walked(leash, (0.6, 0.8)) == pytest.approx(
        (0.6 - 0.2 / np.hypot(0.2, 0.8) * 0.2, 0.8 - 0.16 / np.hypot(0.2, 0.8))
    )


def test_it_catches_up_softly():
    leash = Leash(SHORT_M, share=0.25)
    ways = [float(walked(leash, (0.6, 0.0))[0]) for _ in range(60)]
    assert ways[:2] == pytest.approx((0.1, 0.175))
    assert (np.diff(ways) > 0.0).all()
    assert ways[-1] == pytest.approx(0.4, abs=1e-6)


def test_a_robot_put_elsewhere_is_where_it_goes_and_near_the_origin_that_is_the_origin():
    leash = Leash(SHORT_M, share=0.1)
    assert walked(leash, (2.0, 0.5)) == pytest.approx((2.0, 0.5))
    assert not walked(leash, (0.05, 0.1)).any()
    leash.settle(np.array((0.3, 0.0)))
    assert leash.point == pytest.approx((0.3, 0.0))
