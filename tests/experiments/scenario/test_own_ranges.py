"""What a robot may be asked for goes with its size: Bip's ranges are as they were, a small robot has its own."""

import math

import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.own_ranges import own_range
from surefoot.experiments.scenario.proportions import proportions_of
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.experiments.scenario.references import build_gait, even_steps
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, scenario_from_table, shipped_scenarios
from surefoot.gait.footsteps import step_limits
from surefoot.gait.scale import gait_scale
from surefoot.gait.step_adjustment import WIDTHS_M
from surefoot.robot.description import load_robot
from surefoot.robot.feet import Support
from tests.support.humanoids import path_of
from tests.support.small_biped import LEG, biped

OTHER = "offset"
BIPS = {
    "reference.step_length_m": "-0.3 to 0.5 m",
    "reference.step_width_m": "0.16 to 0.4 m",
    "reference.step_period_s": "0.3 to 3 s",
    "reference.lift_m": "0.01 to 0.15 m",
    "ground.tiles.size_m": "0.05 to 0.5 m",
}


@pytest.fixture
def tiny(tmp_path):
    """Legs of 0.25 m, soles of 60 x 30 mm."""
    leg = [(name, axis, offset.replace("-0.25", "-0.11"), 0.1 * mass) for name, axis, offset, mass in LEG]
    sole = '<geom type="box" size="0.03 0.015 0.01" pos="0.01 0 -0.02" group="3"/>'
    (tmp_path / "tiny.xml").write_text(biped(leg=leg, sole=sole))
    return str(tmp_path / "tiny.xml")


def refusal(changes, robot):
    with pytest.raises(InvalidInput) as caught:
        load_scenario("walk_flat", {**changes, "robot": robot}, robot_files=True)
    return caught.value


@pytest.mark.parametrize("path", list(BIPS))
@pytest.mark.parametrize("value", [-3.0, 7.0])
def test_bip_is_told_its_own_range(path, value):
    error = refusal({path: value}, "bip")
    assert (error.field, error.value, list(error.valid)) == (path, value, [BIPS[path]])


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_what_is_no_length_is_refused_before_the_robot_is_asked(value):
    with pytest.raises(InvalidInput, match="finite"):
        ReferenceSpec(step_width_m=value)


def test_another_robot_is_told_its_own():
    """``offset``: ankles 0.2 m apart where Bip's are 0.22 m, legs of 0.633 m where Bip's are 0.82 m."""
    ends = [float(f"{0.2 / 0.22 * end:.3g}") for end in (0.16, 0.4)]
    error = refusal({"reference.step_width_m": 0.14}, OTHER)
    assert error.field == "reference.step_width_m"
    assert list(error.valid) == [f"{ends[0]:g} to {ends[1]:g} m"]
    assert load_scenario("walk_flat", {"reference.step_width_m": ends[0], "robot": OTHER}).reference.kind == "walk"
    longest = float(f"{0.633 / 0.82 * 0.5:.3g}")
    assert refusal({"reference.step_length_m": longest + 0.002}, OTHER).field == "reference.step_length_m"
    assert load_scenario("walk_flat", {"reference.step_length_m": longest, "robot": OTHER})


def test_steps_that_nobody_makes_need_not_be_in_range(tiny):
    """0.22 m between the feet, the field's own default, is more than it can step; it only stands."""
    assert own_range(ReferenceSpec, "step_length_m", tiny)[1] < ReferenceSpec.step_length_m
    assert Scenario(robot=tiny, support=Support.LEFT).reference == ReferenceSpec()
    with pytest.raises(InvalidInput, match=r"reference\.step_length_m"):
        Scenario(robot=tiny, support=Support.LEFT, reference=ReferenceSpec(step_length_m=0.4))


@pytest.mark.parametrize("name", list(shipped_scenarios()))
def test_every_scenario_is_one_for_a_tiny_robot_too(name, tiny):
    """None of what is in proportion is refused, and none of it was moved to the end of a range."""
    bip, small = load_scenario(name), load_scenario(name, {"robot": tiny}, robot_files=True)
    ratios = proportions_of(tiny)
    if bip.reference.kind == "walk" and not bip.footsteps:
        pairs = {"step_length_m": "leg", "step_width_m": "foot_spread", "step_period_s": "time", "lift_m": "leg"}
        for field, size in pairs.items():
            wanted = getattr(ratios, size) * getattr(bip.reference, field)
            assert getattr(small.reference, field) == pytest.approx(wanted, rel=5e-3)
    for one, two in zip(bip.stones, small.stones, strict=True):
        assert two.height_m == pytest.approx(ratios.sole_width * one.height_m, rel=5e-3)


def test_a_walk_on_footsteps_is_steered_with_steps_of_its_own(tiny):
    scene = load_scenario("step_onto_stone", {"robot": tiny}, robot_files=True)
    steps, ratios = even_steps(scene), proportions_of(tiny)
    assert steps.step_width_m == pytest.approx(0.22 * ratios.foot_spread, abs=1e-4)
    assert build_gait(scene).pace.width_m == steps.step_width_m
    assert even_steps(load_scenario("step_onto_stone")) == load_scenario("step_onto_stone").reference


def test_no_step_of_a_walk_may_be_narrower_than_a_walk_may_be():
    """The one width, in the scenario, in the check of footsteps and where steps are moved."""
    for robot in ("bip", OTHER):
        scale = gait_scale(load_robot(robot))
        least = own_range(ReferenceSpec, "step_width_m", robot)[0]
        assert step_limits(scale)[1][0] == pytest.approx(least, rel=5e-3)
        assert scale.widths(WIDTHS_M)[0] == pytest.approx(least, rel=5e-3)


def test_a_table_of_a_tiny_robot_may_hold_what_is_too_small_for_bip(tiny):
    ground = {"tiles": {"size_m": 0.02}}
    table = {"robot": tiny, "support": "double", "duration_s": 1.0, "reference": {"kind": "walk"}, "ground": ground}
    assert scenario_from_table(table, robot_files=True).ground.tiles.size_m == 0.02
    with pytest.raises(InvalidInput, match=r"ground\.tiles\.size_m"):
        scenario_from_table({**table, "robot": "bip"})


@pytest.mark.robots
@pytest.mark.parametrize("robot", ["op3", "g1", "t1"])
def test_a_humanoid_is_asked_for_every_scenario_and_stands_as_wide_as_it_walks(robot):
    path = str(path_of(robot))
    for name in shipped_scenarios():
        load_scenario(name, {"robot": path}, robot_files=True)
    walk = load_scenario("walk_flat", {"robot": path}, robot_files=True)
    apart = 2.0 * walk.robot_description().sizes.foot_spread_m
    assert walk.reference.step_width_m == pytest.approx(apart, rel=5e-3)
