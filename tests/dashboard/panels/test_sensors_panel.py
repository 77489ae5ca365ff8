"""The panel of sensors: menus act at once, figures by their button, and all follow what is at work."""

from types import SimpleNamespace

import pytest

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.panels.sensors.sensors import SensorsPanel, sensing_html
from surefoot.estimation.registry import estimators
from tests.support.playback import ticks
from tests.support.plug_ins import installed, put_package

BROWSER = SimpleNamespace()


@pytest.fixture
def panel(server, playback):
    return SensorsPanel(SimpleNamespace(gui=server.gui, send=playback.apply, newest=playback.snapshot))


def widgets(server):
    return {handle.label: handle for handle in server.gui._gui_input_handle_from_uuid.values()}


def choose(server, label, value):
    """As viser does when a person chooses."""
    handle = widgets(server)[label]
    handle.value = value
    for callback in handle._impl.update_cb:
        callback(SimpleNamespace(client=BROWSER, target=handle))


def press(server):
    for callback in widgets(server)["Start with these figures"]._impl.update_cb:
        callback(SimpleNamespace(client=BROWSER))


def test_menus_act_at_once_and_the_sliders_follow(server, panel, playback):
    choose(server, "Sensors", "robot")
    assert playback.live.sensing.sensors.preset == "robot"
    panel.show(playback.snapshot())
    assert widgets(server)["Encoder noise [rad]"].value == 1e-3
    assert widgets(server)["IMU latency [s]"].value == 0.003
    assert "Nobody reads" in sensing_html(playback.live.sensing)
    choose(server, "Estimator", "anchor")
    panel.show(playback.snapshot())
    assert playback.live.sensing.estimator == "anchor"
    assert "<b>anchor</b>" in sensing_html(playback.live.sensing)


def test_only_the_figures_that_were_moved_change(server, panel, playback):
    choose(server, "Sensors", "robot")
    panel.show(playback.snapshot())
    widgets(server)["Foot force bias [N]"].value = 0.1 + 0.2  # with the dust that a slider has
    widgets(server)["Seed"].value = 12.0
    press(server)
    sensing = playback.live.sensing
    assert dict(sensing.own_figures) == {"foot_force_bias_n": 0.3}
    assert sensing.sensors.seed == 12
    assert "Foot force bias 0.3" in sensing_html(sensing)


def test_figures_under_the_hand_stay_until_something_else_is_at_work(server, panel, playback):
    widgets(server)["Gyro noise [rad/s]"].value = 0.25
    ticks(playback, 5)
    panel.show(playback.snapshot())
    assert widgets(server)["Gyro noise [rad/s]"].value == 0.25
    playback.apply(cmd.ChangeSensing({"preset": "lab"}))
    panel.show(playback.snapshot())
    assert widgets(server)["Gyro noise [rad/s]"].value == 0.0019


def test_an_estimator_from_outside_is_in_the_menu(server, playback, tmp_path):
    put_package(tmp_path, "strapdown", {"strapdown": "tests.support.strapdown:STRAPDOWN"}, "surefoot.estimators")
    with installed(tmp_path):
        SensorsPanel(SimpleNamespace(gui=server.gui, send=playback.apply, newest=playback.snapshot))
        assert widgets(server)["Estimator"].options == tuple(estimators())
        assert "strapdown" in estimators()
