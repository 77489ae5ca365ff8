"""The heights that a refusal names are true: both ends stand with every joint in range, beyond them none does."""

import re

import pytest

from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import PostureError
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.heights import heights_in_range, solve_start
from surefoot.experiments.scenario.scenario import scenario_from_table


def scenario(support: str, height: float, **ground: float):
    return scenario_from_table(
        {"robot": "bip", "support": support, "duration_s": 0.1, "com_height_m": height, "ground": ground}
    )


@pytest.mark.parametrize("support", ["left", "right", "double"])
def test_the_range_that_is_named_is_the_range(robot, support):
    with pytest.raises(PostureError) as refused:
        build_simulation(scenario(support, 1.15), "two-part", rows=1)
    named = re.search(r"com_height_m from (\d\.\d+) to (\d\.\d+) m keeps every joint in range", str(refused.value))
    low, high = map(float, named.groups())
    dynamics = DynamicsModel(robot)
    for height in (low, high, 0.5 * (low + high)):
        assert not solve_start(scenario(support, height), dynamics).out_of_range
    for height in (low - 0.001, high + 0.001):
        try:
            assert solve_start(scenario(support, height), dynamics).out_of_range
        except PostureError:
            assert height > high


def test_where_not_even_the_usual_height_is_in_range_nothing_is_promised():
    steep = scenario("left", 1.15, slope_deg=20.0, direction_deg=90.0)
    assert heights_in_range("bip", steep.support, steep.ground) is None
    with pytest.raises(PostureError) as refused:
        build_simulation(steep, "two-part", rows=1)
    assert "com_height_m" not in str(refused.value)
