"""A NaN of MuJoCo or Pinocchio: a fall by ``nan``, and no NaN where the page draws."""

import dataclasses

import mujoco
import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.simulation import plant
from tests.support.playback import texts, ticks

AT_TICK = 12
MAY_BE_UNKNOWN = {"zmp_measured", "zmp_commanded", "capture", "trail"}


@pytest.fixture
def spoil_step(monkeypatch):
    """Let MuJoCo leave a NaN behind in one of its arrays, in one step of the runs to come."""

    def put(array, step=AT_TICK):
        count, real = [0], mujoco.mj_step

        class Spoilt:
            def __getattr__(self, name):
                return getattr(mujoco, name)

            def mj_step(self, model, data):
                real(model, data)
                count[0] += 1
                if count[0] == step:
                    getattr(data, array)[7] = np.nan

        monkeypatch.setattr(plant, "mujoco", Spoilt())

    return put


def until_it_pauses(playback):
    """Tick until it pauses, a snapshot after each; the last."""
    snapshot = playback.snapshot()
    while playback.playing:
        playback.tick()
        snapshot = playback.snapshot()
        fields = (item.name for item in dataclasses.fields(Geometry) if item.name not in MAY_BE_UNKNOWN)
        drawn = [getattr(snapshot.geometry, name) for name in fields]
        assert all(np.isfinite(part).all() for part in drawn if isinstance(part, np.ndarray))
    return snapshot


@pytest.mark.parametrize("array", ["qpos", "qvel"])
@pytest.mark.parametrize("scenario", ["stand_left", "stand_double"])
def test_a_step_that_bursts_is_a_fall_and_the_robot_is_shown_where_it_was(spoil_step, scenario, array):
    spoil_step(array)
    playback = Playback(scenario, "two-part")
    snapshot = until_it_pauses(playback)
    assert (snapshot.balance.fall_cause, snapshot.balance.ended) == ("nan", True)
    assert np.isfinite(snapshot.traces[:, :7]).all()
    assert "by nan" in texts(playback, EventKind.FALL)[0]
    playback.apply(cmd.Reset())
    assert ticks(playback, 20).fall_cause is None


def test_headless_the_ticks_before_are_kept(spoil_step):
    spoil_step("qpos")
    result = run(load_scenario("stand_double", {"duration_s": 0.05}), "two-part")
    assert (result.summary["fall_cause"], result.summary["error"]) == ("nan", None)
    assert result.summary["fall_time_s"] == result.summary["duration_s"] == pytest.approx(AT_TICK * 1e-3)
    assert len(result.recorder) == AT_TICK - 1
    nothing_acts = [name.startswith("external_force_at_") for name in result.recorder.columns]
    assert np.isfinite(result.recorder.table()[:, np.logical_not(nothing_acts)]).all()


def everywhere(terms):
    for item in dataclasses.fields(terms):
        value = getattr(terms, item.name)
        if isinstance(value, np.ndarray):
            setattr(terms, item.name, np.full_like(value, np.nan))


def in_the_mass_matrix(terms):
    terms.mass_matrix = np.full_like(terms.mass_matrix, np.nan)


def in_a_foot(terms):
    terms.feet[0].jacobian = np.full_like(terms.feet[0].jacobian, np.nan)


@pytest.mark.parametrize("spoil", [everywhere, in_the_mass_matrix, in_a_foot])
@pytest.mark.parametrize("controller", ["two-part", "soft-qp", "two-part-literal"])
def test_dynamics_that_are_no_numbers_are_no_fault_of_the_controller(monkeypatch, controller, spoil):
    playback = Playback("stand_left", controller)
    ticks(playback, AT_TICK)
    dynamics = playback.live.simulation._dynamics
    real = dynamics.evaluate

    def evaluate(state):
        terms = real(state)
        spoil(terms)
        return terms

    monkeypatch.setattr(dynamics, "evaluate", evaluate)
    snapshot = until_it_pauses(playback)
    assert (snapshot.balance.fall_cause, playback.live.simulation.error) == ("nan", None)
    assert snapshot.time_s == pytest.approx(AT_TICK * 1e-3)
