"""The panel's button starts the walk that its widgets say, which repeats as any other run does."""

from types import SimpleNamespace

import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.live.rerun import rerun
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.command_check import check_command
from surefoot.dashboard.messages.run_link import link_query
from surefoot.dashboard.panels.walk.walk import WalkPanel
from surefoot.dashboard.panels.walk.walk_ground import SLOPES, TILES, word_of
from surefoot.experiments.runs.comparison import difference
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.scenario.scenario import load_scenario
from tests.support.playback import recorded_ticks, texts, ticks
from tests.support.rewinding import first_difference

WANTED = {
    "Steps": 4,
    "Step length [m]": 0.1 + 0.2,  # with the dust that a slider has
    "Step width [m]": 0.2,
    "Step period [s]": 0.7,
    "Double support share [-]": 0.3,
    "Foot lift [m]": 0.04,
    "Turn per step [°]": 5.0,
    "First foot": "right",
    "Tiles": "±10 mm",
    "Stones under steps [mm]": 15.0,
    "Slope": "5° down",
}


@pytest.fixture
def panel(server, playback):
    return WalkPanel(SimpleNamespace(gui=server.gui, send=playback.apply, newest=playback.snapshot))


def widgets(server):
    return {handle.label: handle for handle in server.gui._gui_input_handle_from_uuid.values()}


def press(server):
    """As viser does when a person presses the button."""
    for callback in widgets(server)["Walk"]._impl.update_cb:
        callback(SimpleNamespace(client=None))


def set_all(server, values):
    for label, value in values.items():
        widgets(server)[label].value = value


def test_the_walk_is_what_the_widgets_say(server, panel, playback):
    set_all(server, WANTED)
    press(server)
    spec, ground = playback.live.scenario.reference, playback.live.scenario.ground
    assert (spec.kind, spec.steps, spec.step_length_m, spec.step_width_m) == ("walk", 4, 0.3, 0.2)
    assert (spec.step_period_s, spec.double_support_share, spec.lift_m) == (0.7, 0.3, 0.04)
    assert (spec.turn_deg_per_step, spec.first_foot) == (5.0, "right")
    assert ground.tiles is not None
    assert (ground.tiles.amplitude_m, ground.slope_deg, ground.direction_deg) == (0.01, 5.0, 180.0)
    assert playback.live.scenario.stones_under_steps.height_m == 0.015
    assert len(playback.snapshot().terrain.blocks) > 4


def test_what_nobody_has_touched_is_the_shipped_walk(server, panel, playback):
    press(server)
    assert playback.live.scenario == load_scenario("walk_flat")
    assert playback.playing


def test_a_walk_of_the_panel_is_rewound_forked_rerun_and_linked_to_the_bit(server, panel, playback, tmp_path):
    set_all(server, {"Steps": 2, "Step length [m]": 0.15, "Tiles": "±10 mm"})
    press(server)
    ticks(playback, 850)
    once = recorded_ticks(playback, 200)
    playback.apply(cmd.Seek(0.85))
    assert first_difference(once, recorded_ticks(playback, 200)) is None
    playback.apply(cmd.Seek(0.9))
    playback.apply(cmd.ChangeSettings({"com_weight": 12.0}))  # a fork
    playback.apply(cmd.UndoSettings())
    ticks(playback, 50)
    write_run(playback.saved_run(), tmp_path / "walk.npz")
    kept = read_run(tmp_path / "walk.npz")
    assert difference(kept, rerun(kept)) is None
    query = link_query(playback.snapshot())
    assert query is not None
    other = Playback("stand_left", "two-part")
    other.apply(cmd.OpenLink(query))
    ticks(other, 850)
    assert first_difference(once, recorded_ticks(other, 200)) is None


def test_the_widgets_take_over_a_walk_that_was_started_otherwise_and_keep_what_a_person_wants(server, panel, playback):
    changes = {"reference.steps": 7, "reference.lift_m": 0.06, "ground.slope_deg": 5.0, "ground.direction_deg": 90.0}
    playback.apply(cmd.LoadScenario("walk_flat", {**changes, "stones_under_steps.height_m": 0.02}))
    panel.show(playback.snapshot())
    seen = {label: handle.value for label, handle in widgets(server).items() if label in WANTED}
    assert (seen["Steps"], seen["Foot lift [m]"]) == (7, 0.06)
    assert (seen["Slope"], seen["Tiles"]) == ("5° up to the left", "none")
    assert seen["Stones under steps [mm]"] == pytest.approx(20.0)
    press(server)
    widgets(server)["Steps"].value = 3  # before the walk is seen
    panel.show(playback.snapshot())
    assert widgets(server)["Steps"].value == 3
    playback.apply(cmd.LoadScenario("walk_flat"))
    panel.show(playback.snapshot())
    assert widgets(server)["Steps"].value == 10


def test_a_number_out_of_range_is_refused_in_words_and_changes_nothing(server, panel, playback):
    before = playback.live.simulation
    widgets(server)["Steps"].value = 3000
    press(server)
    assert playback.live.simulation is before
    assert "1 to 2000" in texts(playback, "error")[0]


@pytest.mark.parametrize("menu", [TILES, SLOPES])
def test_every_word_of_a_menu_is_known_again(menu):
    for word, meaning in menu.items():
        command = cmd.LoadScenario("walk_flat", meaning)
        check_command(command)
        assert word_of(menu, {"reference.steps": 3, **meaning}) == word
    assert word_of(menu, dict.fromkeys((path for meaning in menu.values() for path in meaning), 0.017)) is None


def test_steps_that_are_no_whole_number_are_refused_in_words(server, panel, playback):
    steps = widgets(server)["Steps"]
    playback.apply(cmd.LoadScenario("walk_flat", {"reference.steps": 7}))
    panel.show(playback.snapshot())
    assert (steps.value, type(steps.value)) == (7.0, float)  # of an int viser makes ints, and 12.5 became 12
    steps.value = 12.5
    press(server)
    assert "reference.steps = 12.5: must be a whole number" in texts(playback)[0]
