"""Where emergency steps go and when: they end with feet that can stand, and no foot hurries in vain."""

import pytest

from surefoot.gait.emergency_step import FOLLOWS_S, LANDING_S, STANDS_M, EmergencyStep, step_timing
from surefoot.gait.footsteps import Footstep, feet_now
from surefoot.gait.progress import Phase
from surefoot.gait.scale import BIP
from surefoot.gait.walk import Walk
from surefoot.momentum.zmp import natural_frequency
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FULLY_LOADED
from surefoot.task.posture import standing_reference


@pytest.fixture
def terms(standing):
    return standing(Support.DOUBLE)


def walk_of(robot, terms, *steps: Footstep) -> Walk:
    return Walk(robot, standing_reference(robot, Support.DOUBLE), steps, step_timing(0.0, BIP), adjusts=False)


@pytest.mark.parametrize("ahead_m", [0.25, -0.2])
def test_the_other_foot_follows_a_step_that_lands_too_far_ahead_or_behind_to_stand_so(robot, terms, ahead_m):
    left, right = feet_now(robot, terms)
    walk = walk_of(robot, terms, left)  # the last of the steps: beside the right foot
    walk.step_now(0.0, terms)
    steps, omega = EmergencyStep(robot), natural_frequency(float(terms.position_com_in_world[2]))
    steps.aim(walk, 1.0, terms, right.point + (0.02, 0.0), omega)  # the capture point rests in the right sole
    assert [step.foot for step in walk.footsteps] == [0]
    steps.aim(walk, 1.0, terms, right.point + (ahead_m, 0.0), omega)
    step, follows = walk.footsteps
    assert abs(step.point[0] - right.point[0]) > STANDS_M
    assert (step.foot, follows.foot) == (0, 1)
    assert follows.point[0] == pytest.approx(step.point[0])  # beside it
    assert 0.17 < step.point[1] - follows.point[1] < 0.38


@pytest.mark.parametrize(
    ("ahead_m", "outward_m", "hurries"),
    [(0.03, 0.0, False), (0.03, 0.06, False), (0.15, 0.0, True), (-0.1, 0.0, True), (0.03, -0.11, True)],
    ids=["middle", "near the outer edge", "near the toe", "near the heel", "between the feet"],
)
def test_the_foot_that_follows_hurries_only_where_its_landing_helps(robot, terms, ahead_m, outward_m, hurries):
    """The left foot is to be lifted: it cannot be set down to the right of the right one."""
    left, right = feet_now(robot, terms)
    walk, held = walk_of(robot, terms, left), standing_reference(robot, Support.DOUBLE)
    steps, omega = EmergencyStep(robot), natural_frequency(float(terms.position_com_in_world[2]))
    walk.tick(terms, FULLY_LOADED, held)
    assert walk.phase is Phase.DOUBLE
    steps.follow_in_time(walk, terms, right.point + (ahead_m, -outward_m), omega)
    walk.step_now(0.0, terms)
    lasts_s = LANDING_S if hurries else FOLLOWS_S
    assert walk.progress.left_s == pytest.approx(lasts_s)
