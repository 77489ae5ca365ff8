"""A live run of a robot that does not know its state: chosen, rewound, forked, linked and kept."""

import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.live.rerun import rerun
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.run_link import link_query
from surefoot.dashboard.messages.sensing import own_figures
from surefoot.estimation.interface import Estimate
from surefoot.estimation.registry import EstimatorEntry
from surefoot.experiments.runs.comparison import difference
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.scenario.scenario import load_scenario
from tests.support.playback import bits, recorded_ticks, texts, ticks
from tests.support.plug_ins import installed, put_package
from tests.support.rewinding import first_difference

OURS = ("anchor", "invariant-ekf")


class Failing:
    """Believes what it is told at the start, for ten ticks."""

    def __init__(self, *_) -> None:
        self.left = 10

    def reset(self, state):
        self.state = state

    def tick(self, readings):
        self.left -= 1
        if self.left < 0:
            raise RuntimeError("out of ideas")
        return Estimate(self.state, readings.feet, np.eye(9))


FAILING = EstimatorEntry("failing", "fails after ten ticks", Failing)


def sensing(playback: Playback, estimator: str = "anchor", **sensors) -> Playback:
    playback.apply(cmd.ChangeSensing({"preset": "cheap", "seed": 5, **sensors}, estimator))
    return playback


def test_a_change_starts_the_scenario_again_and_says_so(playback):
    ticks(playback, 20)
    playback.apply(cmd.SetFriction(0.45))
    run = playback.runs
    sensing(playback)
    assert playback.runs == run + 1
    assert playback.live.simulation.time_s == 0.0
    assert playback.live.simulation.senses.name == "anchor"
    assert playback.live.friction == 0.45
    assert any("sensors cheap, seed 5; estimator anchor" in text for text in texts(playback))
    run = playback.runs
    playback.apply(cmd.ChangeSensing({"preset": "cheap", "seed": 5}, "anchor"))  # nothing new
    assert playback.runs == run


def test_a_figure_is_changed_alone_and_a_preset_takes_it_back(playback):
    sensing(playback)
    before = playback.live.sensing.sensors
    playback.apply(cmd.ChangeSensing({"encoder_noise_rad": 0.002}))
    now = playback.live.sensing
    assert (now.sensors.preset, now.sensors.seed, now.estimator) == ("cheap", 5, "anchor")
    assert dict(own_figures(now.sensors)) == {"encoder_noise_rad": 0.002}
    assert now.sensors.gyro_noise_rad_s == before.gyro_noise_rad_s
    playback.apply(cmd.ChangeSensing({"preset": "cheap"}))
    assert playback.live.sensing.sensors == before


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (cmd.ChangeSensing({"preset": "best"}), "perfect, lab, robot, cheap"),
        (cmd.ChangeSensing({"gyro": 1.0}), "gyro_noise_rad_s"),
        (cmd.ChangeSensing({"gyro_noise_rad_s": float("nan")}), "0 to 1 rad/s"),
        (cmd.ChangeSensing(estimator="oracle"), "truth, anchor, invariant-ekf"),
        (cmd.ChangeSensing(motors={"preset": "best"}), "perfect, lab, robot, cheap"),
        (cmd.ChangeSensing(model_error={"mass": -1.0}), "0 to 0.3"),
        (cmd.ChangeSensing(control_delay_s=1.0), "0 to 0.02 s"),
    ],
)
def test_what_there_is_not_changes_nothing(playback, command, words):
    ticks(playback, 5)
    before, run = bits(playback), playback.runs
    playback.apply(command)
    assert (bits(playback), playback.runs) == (before, run)
    assert words in texts(playback, "error")[0]


@pytest.mark.parametrize("estimator", OURS)
def test_the_past_comes_again_to_the_bit(playback, estimator):
    sensing(playback, estimator)
    once = recorded_ticks(playback, 260)
    table = playback.live.simulation.recorder.table().tobytes()  # what was believed is in it
    playback.apply(cmd.Seek(0.13))
    assert bits(playback) == once[129]
    assert first_difference(once[130:], recorded_ticks(playback, 130)) is None
    assert playback.live.simulation.recorder.table().tobytes() == table


def test_a_fork_is_a_run_that_was_pushed_there(playback):
    sensing(playback)
    ticks(playback, 230)
    playback.apply(cmd.Seek(0.12))
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=4.0))
    forked = recorded_ticks(playback, 100)
    straight = sensing(Playback("stand_left", "two-part"))
    ticks(straight, 120)
    straight.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=4.0))
    assert first_difference(forked, recorded_ticks(straight, 100)) is None


def test_a_reset_draws_the_same_errors_and_another_seed_others(playback):
    sensing(playback)
    once = recorded_ticks(playback, 60)
    playback.apply(cmd.Reset())
    assert recorded_ticks(playback, 60) == once
    playback.apply(cmd.ChangeSensing({"seed": 6}))
    assert recorded_ticks(playback, 60)[-1] != once[-1]


def test_a_link_says_the_preset_and_what_differs_from_it(playback):
    sensing(playback, encoder_noise_rad=0.002)
    query = link_query(playback.snapshot())
    assert query is not None
    assert "sensors.preset=cheap&sensors.seed=5&sensors.encoder_noise_rad=0.002&estimator.kind=anchor" in query
    other = Playback("stand_left", "two-part")
    other.apply(cmd.OpenLink(query))
    assert other.live.scenario == playback.live.scenario
    assert recorded_ticks(other, 40) == recorded_ticks(playback, 40)


def test_motors_model_and_delay_change_alone_and_the_log_says_so(playback):
    sensing(playback)
    sensors = playback.live.sensing.sensors
    playback.apply(cmd.SetFriction(0.45))
    playback.apply(cmd.ChangeSensing(motors={"preset": "robot"}, model_error={"mass": 0.05, "seed": 4}))
    playback.apply(cmd.ChangeSensing(control_delay_s=0.002))
    assert playback.live.sensing.sensors == sensors
    assert playback.live.friction == 0.45
    plant = playback.live.simulation.plant
    assert plant.imperfections.motors.preset == "robot"
    assert plant.mass_kg != playback.live.simulation.robot.mass_kg
    words = "estimator anchor; motors robot; torques 2 ms late; model error perfect, mass = 0.05, seed 4"
    assert any(words in text for text in texts(playback))


def test_another_scenario_keeps_them_unless_it_has_its_own(playback, tmp_path):
    sensing(playback)
    playback.apply(cmd.ChangeSensing(motors={"preset": "lab"}, model_error={"preset": "lab"}, control_delay_s=0.001))
    chosen = playback.live.sensing
    playback.apply(cmd.LoadScenario("stand_double"))
    assert playback.live.scenario.name == "stand_double"
    assert playback.live.sensing == chosen
    playback.apply(cmd.LoadScenario("stand_left", {"sensors.preset": "lab", "estimator.kind": "invariant-ekf"}))
    assert (playback.live.sensing.sensors.preset, playback.live.sensing.estimator) == ("lab", "invariant-ekf")
    playback.apply(cmd.OpenLink("scenario=stand_left"))  # a link says all
    assert playback.live.scenario == load_scenario("stand_left")


def test_a_saved_run_is_made_again_from_its_file(playback, tmp_path):
    sensing(playback)
    ticks(playback, 40)
    playback.apply(cmd.PushNow(direction_deg=0.0, impulse_ns=2.0))
    ticks(playback, 60)
    write_run(playback.saved_run(), tmp_path / "believed.parquet")
    kept = read_run(tmp_path / "believed.parquet")
    assert kept.manifest["scenario"]["sensors"]["preset"] == "cheap"
    assert kept.manifest["scenario"]["estimator"]["kind"] == "anchor"
    assert difference(kept, rerun(kept)) is None


def test_an_estimator_that_fails_is_named_and_no_other_controller_is_offered(playback, tmp_path):
    place = "tests.dashboard.live.test_sensing:FAILING"
    put_package(tmp_path, "failing", {"failing": place}, "surefoot.estimators")
    with installed(tmp_path):
        sensing(playback, "failing")
        for _ in range(12):
            if playback.playing:
                playback.tick()
        assert not playback.playing
        assert playback.live.simulation.fallen == "estimator_error"
        assert any("failing" in text and "out of ideas" in text for text in texts(playback))
        assert not any("another controller" in text for text in texts(playback))
        playback.apply(cmd.Play())
        assert not playback.playing
        assert "another controller" not in texts(playback, "error")[0]
        playback.apply(cmd.ChangeSensing(estimator="anchor"))
        ticks(playback, 12)
        assert playback.playing and playback.live.simulation.fallen is None
