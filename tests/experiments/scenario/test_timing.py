"""What can never happen, and what is rounded, is told; what is as asked for is not."""

import json

import pytest

from surefoot.cli.main import main
from surefoot.dashboard.live.playback import Playback
from surefoot.experiments.scenario.scenario import load_scenario, scenario_from_table, shipped_scenarios
from surefoot.experiments.scenario.timing import end_warnings, rounding_warnings

STAND = {"robot": "bip", "support": "left", "duration_s": 3.0}
LATE = {
    "a push": {"pushes": [{"start_s": 10.0}]},
    "a push in the last instant": {"pushes": [{"start_s": 3.0}]},
    "a stone": {"stones": [{"rise_start_s": 3.5}]},
    "a swing": {"reference": {"kind": "swing", "amplitude_m": 0.01, "start_s": 4.0}},
    "a tilt": {"ground": {"slope_deg": 2.0, "tilt_start_s": 3.0, "tilt_duration_s": 1.0}},
}
CUT = {
    "a push": {"pushes": [{"start_s": 2.95, "duration_s": 0.1}]},
    "a stone": {"stones": [{"rise_start_s": 2.9, "rise_duration_s": 0.3}]},
    "a swing": {"reference": {"kind": "swing", "amplitude_m": 0.01, "start_s": 2.8, "duration_s": 0.5}},
    "a tilt": {"ground": {"slope_deg": 2.0, "tilt_start_s": 2.5, "tilt_duration_s": 1.0}},
    "a walk": {"support": "double", "reference": {"kind": "walk", "steps": 3}},
}
IN_TIME = {
    "to the very end": {"pushes": [{"start_s": 2.9, "duration_s": 0.1}]},
    "a walk to its end": {
        "support": "double",
        "duration_s": 2.8,
        "reference": {"kind": "walk", "steps": 2, "start_s": 0.1},
    },
    "a stone that lies there": {"stones": [{"lying": True}]},
    "no tilt": {"ground": {"slope_deg": 2.0}},
    "standing": {},
}


@pytest.mark.parametrize("what", LATE)
def test_what_starts_after_the_end_never_happens(what):
    (line,) = end_warnings(scenario_from_table({**STAND, **LATE[what]}))
    assert line.endswith("the run is over at 3 s, it never happens")


@pytest.mark.parametrize("what", CUT)
def test_what_ends_after_the_end_is_cut(what):
    (line,) = end_warnings(scenario_from_table({**STAND, **CUT[what]}))
    assert line.endswith("the run is over at 3 s, before that")


@pytest.mark.parametrize("what", IN_TIME)
def test_what_happens_in_time_is_not_told(what):
    assert end_warnings(scenario_from_table({**STAND, **IN_TIME[what]})) == ()


@pytest.mark.parametrize("name", shipped_scenarios())
def test_what_ships_happens_as_it_says(name):
    scenario = load_scenario(name)
    assert (*end_warnings(scenario), *rounding_warnings(scenario)) == ()


@pytest.mark.parametrize(("delay", "taken"), [(0.0004, "0 s"), (0.0016, "0.002 s"), (0.0025, "0.002 s")])
def test_a_delay_that_is_no_whole_tick_is_told(delay, taken):
    (line,) = rounding_warnings(scenario_from_table({**STAND, "physics": {"control_delay_s": delay}}))
    assert f"= {delay:g} s is no whole number of ticks of 1 ms: {taken} is what it is taken for" in line


@pytest.mark.parametrize("delay", [0.0, 0.003, 0.001 + 0.002])
def test_a_whole_tick_is_one_whatever_its_last_digit(delay):
    assert rounding_warnings(scenario_from_table({**STAND, "physics": {"control_delay_s": delay}})) == ()


def test_a_duration_that_is_no_whole_tick_is_told():
    (line,) = end_warnings(scenario_from_table({**STAND, "duration_s": 0.0105}))
    assert line.startswith("duration_s = 0.0105 s")


def test_warnings_are_in_the_summary_and_beside_its_json(capsys):
    main(["run", "push_left", "--set", "duration_s=0.01", "--json"])
    printed = capsys.readouterr()
    (said,) = json.loads(printed.out)["warnings"]
    assert "pushes.0 starts at" in said
    assert printed.err == f"surefoot: warning: {said}\n"


def test_the_page_tells_what_is_rounded_and_waits_for_what_comes_late():
    table = {**STAND, "duration_s": 0.5, "physics": {"control_delay_s": 0.0016}, **LATE["a push"]}
    playback = Playback(scenario_from_table(table), "two-part")
    texts = [event.text for event in playback.live.log.events]
    assert sum("warning: physics.control_delay_s" in text for text in texts) == 1
    assert not any("pushes.0" in text for text in texts)
