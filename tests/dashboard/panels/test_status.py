"""The header's words about a walk."""

import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.panels.header.status import walk_html
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.gait.progress import Phase, Progress


@pytest.mark.parametrize(
    ("phase", "alone", "words"),
    [
        (Phase.WAITING, None, "waiting<"),
        (Phase.DOUBLE, None, "double support<"),
        (Phase.SINGLE, 0, "single support left<"),
        (Phase.SINGLE, 1, "single support right<"),
        (Phase.STANDING, None, "standing<"),
    ],
)
def test_a_walk_says_its_phase_and_how_many_steps_it_has_made(phase, alone, words):
    html = walk_html(Progress(phase=phase, alone=alone, made=3, planned=10))
    assert words in html
    assert "3 of 10 steps" in html


def test_only_a_scenario_that_walks_says_so(playback):
    assert playback.snapshot().walk is None
    assert walk_html(None) == ""
    walk = Playback(load_scenario("walk_flat"), "two-part").snapshot().walk
    assert (walk.phase, walk.made, walk.planned) == (Phase.WAITING, 0, 10)
