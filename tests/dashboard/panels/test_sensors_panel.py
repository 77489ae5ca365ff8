"""The panel of sensors: menus act at once, figures by their button, and all follow what is at work."""

from types import SimpleNamespace

import pytest

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.sensing import own_figures
from surefoot.dashboard.panels.sensors.plant import PlantPanel
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


def press(server, label="Start with these figures"):
    for callback in widgets(server)[label]._impl.update_cb:
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
    assert dict(own_figures(sensing.sensors)) == {"foot_force_bias_n": 0.3}
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


@pytest.fixture
def plant_panel(server, playback):
    return PlantPanel(SimpleNamespace(gui=server.gui, send=playback.apply, newest=playback.snapshot))


def test_motors_and_model_have_menus_that_act_at_once(server, plant_panel, playback):
    choose(server, "Motors", "cheap")
    assert playback.live.sensing.motors.no_load_speed_rad_s == 12.0
    assert playback.live.simulation.plant.imperfections.motors.bandwidth_hz == 40.0
    choose(server, "Model error", "robot")
    sensing = playback.live.sensing
    assert (sensing.motors.preset, sensing.model_error.preset) == ("cheap", "robot")
    plant_panel.show(playback.snapshot())
    shown = widgets(server)
    assert shown["Torque bandwidth [Hz]"].value == 40.0
    assert shown["Mass centres ± [m]"].value == 0.004
    assert shown["Viscous friction [N·m·s/rad]"].value == 2.0


def test_figures_of_motors_and_model_wait_for_their_button(server, plant_panel, playback):
    run = playback.runs
    shown = widgets(server)
    shown["Torque delay [s]"].value = 0.003
    shown["Masses ± [-]"].value = 0.06
    shown["Seed of the model"].value = 7.0
    shown["Dry friction [-]"].value = 0.02
    assert playback.runs == run
    press(server, "Start with this robot")
    sensing, plant = playback.live.sensing, playback.live.simulation.plant
    assert playback.runs == run + 1
    assert plant.physics.control_delay_s == 0.003
    assert (plant.imperfections.model_error.mass, plant.imperfections.model_error.seed) == (0.06, 7)
    assert dict(own_figures(sensing.motors)) == {"coulomb_share": 0.02}
    assert sensing.sensors.preset == "perfect"


def test_an_estimator_from_outside_is_in_the_menu(server, playback, tmp_path):
    put_package(tmp_path, "strapdown", {"strapdown": "tests.support.strapdown:STRAPDOWN"}, "surefoot.estimators")
    with installed(tmp_path):
        SensorsPanel(SimpleNamespace(gui=server.gui, send=playback.apply, newest=playback.snapshot))
        assert widgets(server)["Estimator"].options == tuple(estimators())
        assert "strapdown" in estimators()
