"""Steering a walk is remembered with its tick like a push: seen again, forked and rerun to the bit."""

import pytest

from surefoot.control.registry import controllers
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.live.rerun import rerun
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.shown_robot import shown_robot
from surefoot.dashboard.panels.walk.steering import steered
from surefoot.experiments.runs.comparison import difference
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.gait.footsteps import Pace
from surefoot.robot.description import load_robot
from tests.support.playback import recorded_ticks, texts, ticks
from tests.support.rewinding import first_difference

LEFT = cmd.SteerWalk(step_length_m=0.15, turn_deg_per_step=10.0)


@pytest.fixture
def walking():
    changes = {"reference.start_s": 0.0, "reference.step_period_s": 0.5, "reference.step_length_m": 0.1}
    return Playback(load_scenario("walk_flat", changes), "two-part")


def test_a_steered_walk_is_rewound_forked_and_rerun_to_the_bit(walking, tmp_path):
    ticks(walking, 800)  # the first foot is in the air
    walking.apply(LEFT)
    once = recorded_ticks(walking, 500)  # the second too, on its new way
    walk = walking.live.simulation.gait
    assert walk.footsteps[0].yaw_rad == 0.0 < walk.footsteps[1].yaw_rad
    steps = walk.footsteps
    walking.apply(cmd.Seek(0.75))
    assert walking.live.simulation.gait.footsteps[1].yaw_rad == 0.0  # as it was
    assert walking.snapshot().walk.pace.length_m == 0.1
    walking.apply(cmd.Seek(0.8))
    assert first_difference(once, recorded_ticks(walking, 500)) is None
    assert all(one.yaw_rad == two.yaw_rad for one, two in zip(walk.footsteps, steps, strict=True))

    walking.apply(cmd.Seek(0.79))
    walking.apply(cmd.StopWalk())  # a fork: the turn that came later comes again
    assert "1 later disturbance" in texts(walking, "fork")[0]
    assert len(walk.footsteps) == 2
    ticks(walking, 30)
    assert walk.pace.length_m == 0.15
    write_run(walking.saved_run(), tmp_path / "steered.npz")
    kept = read_run(tmp_path / "steered.npz")
    assert difference(kept, rerun(kept)) is None


def test_what_a_scenario_refuses_is_refused_in_words_and_nothing_changes(walking):
    walk = walking.live.simulation.gait
    before = walk.footsteps
    for command, valid in (
        (cmd.SteerWalk(step_length_m=0.6, turn_deg_per_step=0.0), "-0.3 to 0.5"),
        (cmd.SteerWalk(step_length_m=0.2, turn_deg_per_step=-21.0), "-20 to 20"),
        (cmd.SteerWalk(step_length_m=0.2, turn_deg_per_step=0.0, steps=3000), "1 to 2000"),
    ):
        walking.apply(command)
        assert valid in texts(walking, "error")[0]
    assert walk.footsteps is before


@pytest.mark.parametrize("scenario", ["stand_left", "push_and_step"])
def test_who_does_not_walk_cannot_be_steered(scenario):
    playback = Playback(scenario, next(iter(controllers())))
    for command in (LEFT, cmd.StopWalk()):
        playback.apply(command)
        assert "does not walk" in texts(playback, "error")[0]


@pytest.mark.parametrize(
    ("word", "pace", "wanted"),
    [
        ("faster", Pace(length_m=0.1 + 0.2, width_m=0.2), cmd.SteerWalk(step_length_m=0.35, turn_deg_per_step=0.0)),
        ("faster", Pace(length_m=0.48, width_m=0.2), cmd.SteerWalk(step_length_m=0.5, turn_deg_per_step=0.0)),
        ("slower", Pace(length_m=0.0, width_m=0.2), cmd.SteerWalk(step_length_m=-0.05, turn_deg_per_step=0.0)),
        ("turn left", Pace(length_m=0.1, width_m=0.2), cmd.SteerWalk(step_length_m=0.1, turn_deg_per_step=5.0)),
        ("turn right", Pace(length_m=0.1, width_m=0.2), cmd.SteerWalk(step_length_m=0.1, turn_deg_per_step=-5.0)),
        (
            "straight on",
            Pace(length_m=0.1, width_m=0.2, turn_rad=0.3),
            cmd.SteerWalk(step_length_m=0.1, turn_deg_per_step=0.0),
        ),
        ("go on", Pace(length_m=0.1, width_m=0.2), cmd.SteerWalk(step_length_m=0.1, turn_deg_per_step=0.0, steps=7)),
        ("stop", Pace(length_m=0.1, width_m=0.2), cmd.StopWalk()),
        ("faster", None, cmd.StopWalk()),  # which says that nothing walks
    ],
)
def test_what_a_button_asks_for(word, pace, wanted):
    assert steered(word, pace, 7, shown_robot("bip", load_robot("bip"))) == wanted


def test_a_press_lengthens_the_steps_of_another_robot_in_proportion_up_to_its_own_longest():
    """``offset``: legs of 0.633 m where Bip's are 0.82 m."""
    robot = shown_robot("offset", load_robot("offset"))
    ratio = 0.633 / 0.82
    for length_m, wanted in ((0.1, 0.1 + 0.05 * ratio), (0.37, 0.5 * ratio)):
        command = steered("faster", Pace(length_m=length_m, width_m=0.2), 7, robot)
        assert command.step_length_m == pytest.approx(wanted, rel=5e-3)
