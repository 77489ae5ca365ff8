"""The delta_P reference on the page: its admissible range, its prediction, and planned feed-forward while it runs."""

import pytest

from surefoot.dashboard.messages.commands import ChangeSettings, LoadScenario
from surefoot.dashboard.panels.tuning.gains import bias_html
from tests.support.playback import texts


def test_no_reference_predicts_no_shift(playback):
    assert playback.live.bias.displacement_mm == pytest.approx((0.0, 0.0))
    assert playback.live.bias.outside == ()
    assert playback.live.bias.frontal_nm[0] < 0.0 < playback.live.bias.frontal_nm[1]


def test_a_reference_predicts_its_shift_and_the_stage_realises_it(playback):
    start = playback.live.simulation.tick().terms.position_com_in_world
    playback.apply(ChangeSettings({"delta_ref_sagittal_nm": 50.0}))
    forward, _ = playback.live.bias.displacement_mm
    assert -10.0 < forward < -5.0
    for _ in range(2500):
        result = playback.tick()
    shift = 1e3 * float((result.terms.position_com_in_world - start)[0])
    assert shift == pytest.approx(forward, rel=0.05)


def test_a_reference_outside_its_interval_is_told_once(playback):
    playback.apply(ChangeSettings({"delta_ref_frontal_nm": 800.0}))
    playback.apply(ChangeSettings({"com_damping": 15.0}))
    assert sum("admissible interval" in text for text in texts(playback)) == 1


def test_bars_show_interval_mark_and_prediction(playback):
    text = bias_html(playback.snapshot().bias, playback.live.robot)
    low, high = playback.live.bias.sagittal_nm
    assert f"admissible {low:.0f} to {high:.0f} N·m" in text
    assert "predicted CoM shift" in text


def test_planned_feed_forward_live_refuses_an_infeasible_swing_and_takes_a_feasible_one(playback):
    playback.apply(LoadScenario("swing_inward"))
    playback.apply(ChangeSettings({"feedforward": "planned"}))
    assert "outer edge" in texts(playback)[0]
    assert playback.live.settings.feedforward == "acceleration"  # nothing was changed
    playback.apply(LoadScenario("stand_left"))
    playback.apply(ChangeSettings({"feedforward": "planned"}))
    assert playback.live.settings.feedforward == "planned"
