"""The header's words about a walk."""

import re

import numpy as np
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
    html = walk_html(Progress(phase=phase, alone=alone, made=3, planned=10), (500.0, 500.0))
    assert words in html
    assert "3 of 10 steps" in html


def test_only_a_scenario_that_walks_says_so(playback):
    assert playback.snapshot().walk is None
    assert walk_html(None, (0.0, 0.0)) == ""
    walk = Playback(load_scenario("walk_flat"), "two-part").snapshot().walk
    assert (walk.phase, walk.made, walk.planned) == (Phase.WAITING, 0, 10)


@pytest.mark.parametrize(
    ("forces", "carry"),
    [((500.0, 500.0), ["left", "right"]), ((1028.0, 0.0), ["left", ""]), ((5.0, 1020.0), ["", "right"])],
)
def test_the_lamp_shows_which_feet_carry(forces, carry):
    html = walk_html(Progress(phase=Phase.DOUBLE, alone=None, made=0, planned=2), forces)
    assert re.findall(r'data-carries="(\w*)"', html) == carry


@pytest.mark.parametrize(("left_s", "said"), [(0.34, ">0.3 s<"), (-0.26, ">0.3 s late<")])
def test_the_time_that_is_left_of_a_phase_is_said_and_that_it_is_over(left_s, said):
    assert said in walk_html(Progress(phase=Phase.SINGLE, alone=1, made=0, planned=2, left_s=left_s), (0.0, 1028.0))


def test_time_runs_out_as_the_phase_ends():
    playback = Playback(load_scenario("walk_flat", {"reference.steps": 1, "reference.start_s": 0.1}), "two-part")
    seen = {}
    for _ in range(2200):
        playback.tick()
        walk = playback.live.simulation.gait.progress
        seen.setdefault((walk.phase, walk.made), []).append(walk.left_s)
    phases = [(Phase.WAITING, 0), (Phase.DOUBLE, 0), (Phase.SINGLE, 0), (Phase.DOUBLE, 1), (Phase.STANDING, 1)]
    assert list(seen) == phases
    for of in ((Phase.WAITING, 0), (Phase.DOUBLE, 0), (Phase.DOUBLE, 1)):
        assert seen[of][-1] == pytest.approx(0.001, abs=0.0011)
        assert np.diff(seen[of]) == pytest.approx(-0.001)
    assert seen[Phase.SINGLE, 0][0] == pytest.approx(0.64)  # 0.8 of 0.8 s
    assert abs(seen[Phase.SINGLE, 0][-1]) < 0.1  # flat ground: it lands about when it should
    assert set(seen[Phase.STANDING, 1]) == {None}
