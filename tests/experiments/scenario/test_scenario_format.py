"""The scenario format: every documented key is read, and only those."""

import pytest

from surefoot.control.registry import controller_named
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.scenario import load_scenario, shipped_scenarios
from surefoot.robot.feet import Support

MINIMAL = 'robot = "bip"\nsupport = "double"\nduration_s = 2.0\n'


@pytest.fixture
def load(tmp_path):
    def from_text(text: str, changes=None):
        file = tmp_path / "some_name.toml"
        file.write_text(text)
        return load_scenario(file, changes)

    return from_text


def assert_reads(read, **expected) -> None:
    assert {key: getattr(read, key) for key in expected} == expected


def test_full_example_is_read_key_by_key(load, full_example):
    scenario = load(full_example)
    assert scenario.name == "some_name"
    assert scenario.robot == "bip"
    assert scenario.support is Support.LEFT
    assert scenario.duration_s == 0.05
    assert scenario.com_height_m == 0.975
    assert_reads(scenario.reference, kind="swing", axis="lateral", amplitude_m=-0.035, duration_s=0.45, start_s=0.2)
    first, second = scenario.stones
    assert_reads(first, x_m=0.05, y_m=0.07, height_m=0.01, size_m=(0.06, 0.05), rise_start_s=0.5, rise_duration_s=0.3)
    assert_reads(second, x_m=0.0, y_m=0.0, height_m=0.02)
    (push,) = scenario.pushes
    assert_reads(push, link="trunk", direction_deg=90.0, impulse_ns=10.0, start_s=1.0, duration_s=0.1)
    assert_reads(scenario.physics, friction=0.8, mass_scale=1.05, control_delay_s=0.001, torque_limits=False)
    settings = controller_named("two-part").settings(scenario.controller)
    assert (settings.saturation, settings.com_stiffness, settings.guard) == ("clip", 50.0, False)


def test_three_keys_are_enough(load):
    scenario = load(MINIMAL)
    assert scenario.com_height_m is None
    assert scenario.reference.kind == "hold"
    assert scenario.stones == scenario.pushes == ()
    assert scenario.physics.torque_limits is True
    assert scenario.physics.friction == 0.9
    assert dict(scenario.controller) == {}


@pytest.mark.parametrize("key", ["robot", "support", "duration_s"])
def test_each_of_the_three_is_needed(load, key):
    text = "\n".join(line for line in MINIMAL.splitlines() if not line.startswith(key))
    with pytest.raises(InvalidInput, match=f"{key} = None: is missing"):
        load(text)


@pytest.mark.parametrize("name", shipped_scenarios())
def test_shipped_scenarios_are_read_by_name_and_say_what_they_are_for(name):
    scenario = load_scenario(name)
    assert scenario.name == name
    controller_named("two-part").settings(scenario.controller)
    assert shipped_scenarios()[name].read_text().startswith("#")


@pytest.mark.parametrize(
    ("changes", "read", "value"),
    [
        ({"controller.guard": True}, lambda s: s.controller["guard"], True),
        ({"stones.0.height_m": 0.012}, lambda s: s.stones[0].height_m, 0.012),
        ({"stones.1.x_m": 0.2}, lambda s: s.stones[1].x_m, 0.2),
        ({"pushes.0.link": "com"}, lambda s: s.pushes[0].link, "com"),
        ({"support": "right"}, lambda s: s.support, Support.RIGHT),
        ({"physics.friction": 0.5}, lambda s: s.physics.friction, 0.5),
        ({"reference.amplitude_m": 0.01}, lambda s: s.reference.amplitude_m, 0.01),
        ({"com_height_m": 0.98}, lambda s: s.com_height_m, 0.98),
        ({"duration_s": 3}, lambda s: s.duration_s, 3.0),
    ],
)
def test_changes_by_dotted_path(load, full_example, changes, read, value):
    assert read(load(full_example)) != value
    assert read(load(full_example, changes)) == value


def test_changes_may_make_tables_and_lists_that_are_not_there(load, full_example):
    changes = {"pushes.0.impulse_ns": 5.0, "pushes.1.impulse_ns": 6.0, "physics.mass_scale": 1.1, "stones.0.x_m": 0.1}
    scenario = load(MINIMAL, changes)
    assert [push.impulse_ns for push in scenario.pushes] == [5.0, 6.0]
    assert scenario.physics.mass_scale == 1.1
    assert scenario.stones[0].x_m == 0.1
    assert len(load(full_example, {"stones.2.x_m": 0.3}).stones) == 3
