"""Two controllers on the same ground, as the gallery offers them: what its text says comes out."""

import pytest

from surefoot.control.registry import controllers
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages.command_check import check_command
from surefoot.dashboard.messages.commands import LoadScenario, StartTwin
from surefoot.dashboard.panels.scenarios.duels import WALK_OVER_STONES
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario


def test_a_press_starts_both_on_the_same_stones_with_settings_of_the_scenario_alone():
    playback = Playback("stand_left", "soft-qp", {"com_weight": 12.0})
    commands = WALK_OVER_STONES.commands()
    for command in commands:
        check_command(command)
        if not isinstance(command, StartTwin):  # the coordinator gives the twin the first one's scenario
            playback.apply(command)
    assert isinstance(commands[-2], LoadScenario)
    assert isinstance(commands[-1], StartTwin)
    assert commands[-1].controller in controllers()
    assert playback.live.controller == "two-part"
    assert dict(playback.live.changes) == {}
    assert playback.live.scenario == load_scenario("walk_stones", WALK_OVER_STONES.changes)
    assert len(playback.live.simulation.plant.terrain.blocks) == 12


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "first_completes", "twin_completes"), [(0, True, True), (1, True, True), (2, True, True), (3, True, False)]
)
def test_the_walks_end_as_the_text_says(seed, first_completes, twin_completes):
    changes = {**WALK_OVER_STONES.changes, "stones_under_steps.seed": seed}
    summaries = [
        run(load_scenario("walk_stones", changes), controller).summary
        for controller in (WALK_OVER_STONES.first, WALK_OVER_STONES.twin)
    ]
    assert [summary["walk_completed"] for summary in summaries] == [first_completes, twin_completes]
    if seed == WALK_OVER_STONES.changes["stones_under_steps.seed"]:
        assert (summaries[0]["steps_made"], summaries[1]["steps_made"]) == (12, 5)
