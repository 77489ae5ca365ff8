"""P elsewhere than below the ankle: with the tangential bracket it does not matter where, without it it does."""

import numpy as np
import pytest

from surefoot.control.registry import controller_named


@pytest.fixture
def torques_for(simulate, robot):
    """Settings -> torques of one tick in the middle of a swing, when tangential forces are large."""
    moving = simulate(
        controller={"other_joints": "inverse-dynamics"},
        reference={"kind": "swing", "amplitude_m": -0.03, "duration_s": 0.5, "start_s": 0.0},
    )
    for _ in range(100):
        moving.tick()
    state, sensing = moving.plant.sense()
    from surefoot.dynamics.model import DynamicsModel

    terms, wanted = DynamicsModel(robot).evaluate(state), moving.reference.at(state.time_s)

    def decide(**settings):
        entry = controller_named("two-part")
        chosen = entry.settings({"other_joints": "inverse-dynamics", "saturation": "none", "guard": False, **settings})
        return entry.build(robot, chosen).tick(terms, wanted, sensing)

    return decide


def test_with_the_bracket_any_offset_is_the_ankle(torques_for):
    exact = torques_for(p_point="ankle").torques
    moved = torques_for(p_point="offset", p_offset_x_m=0.1, p_offset_y_m=-0.05, p_offset_z_m=0.2).torques
    assert np.abs(moved - exact).max() < 1e-9


def test_without_the_bracket_an_offset_costs_offset_cross_tangential_force(torques_for, robot):
    height = 0.15
    exact, low = (torques_for(p_point="offset", tangential_term=False, p_offset_z_m=z).torques for z in (0.0, -height))
    joint = robot.joint_numbered(5).dof - 6
    assert np.abs(exact - torques_for(p_point="ankle").torques).max() < 1e-9
    difference = np.abs(low - exact)
    assert difference[joint] > 1.0  # height x lateral force [N m]
    ankles = [robot.joint_numbered(k).dof - 6 for k in (5, 6)]
    assert np.delete(difference, ankles).max() < 1e-9  # nothing but the stance ankle sees it
