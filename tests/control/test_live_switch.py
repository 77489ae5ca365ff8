"""Switching controllers while the robot stands: torques fade, they never jump."""

from itertools import permutations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.control.registry import controller_named
from surefoot.control.torque_blend import BLEND_TICKS, TorqueBlend
from surefoot.experiments.scenario.build import build_controller
from surefoot.experiments.scenario.scenario import Scenario

NAMES = ("two-part", "optimization", "soft-qp", "two-part-literal")
# A small push while it stands: the state differs from the reference, so that the controllers disagree.
PUSH = {"direction_deg": 60.0, "impulse_ns": 5.0, "start_s": 0.02, "duration_s": 0.05}


@pytest.mark.parametrize(("old", "new"), list(permutations(NAMES, 2)))
def test_no_joint_torque_jumps_at_a_live_switch(simulate, robot, old, new):
    """No more than 10 % of the difference between new and old in one tick, and 2 N m for what the state changes."""
    simulation = simulate(old, pushes=[PUSH])
    for _ in range(100):
        before = simulation.tick().applied
    entry_torques = before.copy()
    simulation.switch(build_controller(controller_named(new), robot, Scenario()))
    for _ in range(BLEND_TICKS + 10):
        tick = simulation.tick()
        assert tick.fall_cause is None
        allowed = 0.1 * np.abs(tick.output.torques - entry_torques) + 2.0
        assert (np.abs(tick.applied - before) <= allowed).all()
        before = tick.applied
    assert_allclose(tick.applied, tick.output.torques, rtol=0, atol=1e-12)  # the new controller is in charge


def test_blend_goes_from_old_to_new_in_equal_steps():
    blend, old, new = TorqueBlend(), np.zeros(15), np.full(15, 100.0)
    blend.start(old)
    applied = [blend.apply(new)[0] for _ in range(BLEND_TICKS + 5)]
    assert_allclose(np.diff([0.0, *applied[:BLEND_TICKS]]), 100.0 / BLEND_TICKS, rtol=0, atol=1e-9)
    assert applied[BLEND_TICKS - 1 :] == [100.0] * 6


def test_blend_without_a_past_changes_nothing():
    blend, new = TorqueBlend(), np.arange(15.0)
    assert blend.apply(new) is new
    blend.start(None)
    assert blend.apply(new) is new


def test_a_second_switch_starts_from_what_the_motors_hold(simulate, robot):
    """Switching again in the middle of a fade does not go back to the first torques."""
    simulation = simulate("two-part", pushes=[PUSH])
    for _ in range(100):
        before = simulation.tick().applied
    for name in ("two-part-literal", "two-part", "soft-qp"):
        simulation.switch(build_controller(controller_named(name), robot, Scenario()))
        start = before
        for _ in range(20):
            tick = simulation.tick()
            assert (np.abs(tick.applied - before) <= 0.1 * np.abs(tick.output.torques - start) + 2.0).all()
            before = tick.applied
