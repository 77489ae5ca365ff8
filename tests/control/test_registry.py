"""Controllers by name: ours, those that an installed package brings, and clear words about all others."""

from contextlib import ExitStack

import pytest

from surefoot.control.registry import (
    ControllerEntry,
    controller_named,
    controllers,
    entry_point_of,
    unavailable_controllers,
)
from surefoot.errors import ControllerError, InvalidInput
from tests.support.plug_ins import installed, put_package

OURS = ["two-part", "optimization", "soft-qp", "two-part-literal"]

PLUGIN = """
from surefoot.control.registry import ControllerEntry
from surefoot.control.controllers.soft_qp import SoftQP

entry = ControllerEntry("visitor", "a visitor", SoftQP, {"com_stiffness": 30.0})
nothing = "not an entry"
thief = ControllerEntry("soft-qp", "a name of ours", SoftQP)
nameless = ControllerEntry(None, "no name", SoftQP)
list_of_two = ControllerEntry("two,parts", "a list", SoftQP)
helpless = ControllerEntry("helpless", None, SoftQP)
useless = ControllerEntry("useless", "build cannot be called", "SoftQP")
odd = ControllerEntry("odd", "no such setting", SoftQP, {"com_stifness": 30.0})
outside = ControllerEntry("outside", "a value out of range", SoftQP, {"com_stiffness": -1.0})
"""

UNUSABLE = {  # entry point -> what is said of it
    "broken:entry": r"cannot be loaded \(ModuleNotFoundError: No module named 'no_such_module'\)",
    "wordy:entry": r"cannot be loaded \(RuntimeError: many lines of text\)",
    "leaving:entry": r"cannot be loaded \(SystemExit: 3\)",
    "visiting:absent": r"cannot be loaded \(AttributeError: .*absent",
    "visiting:nothing": "is no ControllerEntry but a str",
    "visiting:thief": "the name 'soft-qp', which another controller has",
    "visiting:nameless": "has the name None",
    "visiting:list_of_two": "must be a word",
    "visiting:helpless": "a help that is no text",
    "visiting:useless": "a build that cannot be called",
    "visiting:odd": "preset that cannot be used .*com_stifness",
    "visiting:outside": "preset that cannot be used .*com_stiffness.*out of range",
}


@pytest.fixture
def install(tmp_path):
    """Entry points (name -> value) of a package that is there until the test is over."""

    with ExitStack() as until_the_end:

        def put(**points: str) -> None:
            (tmp_path / "visiting.py").write_text(PLUGIN)
            (tmp_path / "broken.py").write_text("import no_such_module\n")
            (tmp_path / "leaving.py").write_text("raise SystemExit(3)\n")
            (tmp_path / "wordy.py").write_text('raise RuntimeError("many\\nlines\\n\\n  of text")\n')
            put_package(tmp_path, "visiting-controller", points)
            until_the_end.enter_context(installed(tmp_path))

        yield put


def test_the_four_that_ship_are_there_in_order():
    assert list(controllers())[:4] == OURS
    for name in OURS:
        entry = controller_named(name)
        assert entry.name == name
        assert entry.help


def test_an_unknown_name_lists_the_names_there_are():
    with pytest.raises(InvalidInput, match="no such controller") as error:
        controller_named("two-parts")
    assert error.value.valid[:4] == OURS
    assert "two-parts" in str(error.value)


def test_a_controller_of_an_installed_package_is_offered_after_ours(install):
    install(visitor="visiting:entry")
    assert list(controllers()) == [*OURS, "visitor"]
    entry = controller_named("visitor")
    assert isinstance(entry, ControllerEntry)
    assert entry.settings().com_stiffness == 30.0
    assert entry_point_of("visitor").value == "visiting:entry"
    assert not unavailable_controllers()


def test_a_controller_of_an_installed_package_runs(install, simulate):
    install(visitor="visiting:entry")
    simulation = simulate("visitor")
    for _ in range(20):
        assert simulation.tick().fall_cause is None
    assert type(simulation.controller).__name__ == "SoftQP"


@pytest.mark.parametrize(("value", "reason"), UNUSABLE.items(), ids=UNUSABLE)
def test_one_that_cannot_be_used_is_refused_with_its_reason_and_the_others_stay(install, value, reason):
    install(guest=value, visitor="visiting:entry")
    assert list(controllers()) == [*OURS, "visitor"]
    assert controller_named("soft-qp").preset["com_weight"] == 1.0
    assert entry_point_of("two-part") is None
    with pytest.raises(InvalidInput, match=f"controller = 'guest': is not available: {value} .*{reason}") as error:
        controller_named("guest")
    assert error.value.valid == [*OURS, "visitor"]
    assert len(str(error.value).splitlines()) == 1
    assert list(unavailable_controllers()) == ["guest"]
    with pytest.raises(InvalidInput, match="no such controller; guest is not available"):
        controller_named("host")


def test_a_package_whose_entry_points_cannot_be_read_hides_no_other(install, tmp_path):
    broken = put_package(tmp_path, "aaa-broken", {})
    (broken / "entry_points.txt").write_text("[surefoot.controllers]\nno equals sign\n")
    install(visitor="visiting:entry")
    assert list(controllers()) == [*OURS, "visitor"]
    assert "cannot be read" in unavailable_controllers()["aaa-broken"]


@pytest.mark.parametrize(
    ("build", "reason"),
    [
        (lambda robot, settings: 1 / 0, r"cannot be built \(ZeroDivisionError"),
        (lambda robot, settings: None, r"gave a NoneType without tick\(\)"),
    ],
)
def test_one_that_cannot_be_built_is_named_in_one_line(robot, build, reason):
    entry = ControllerEntry("guest", "", build)
    with pytest.raises(ControllerError, match=f"controller guest: .*{reason}"):
        entry.make(robot, entry.settings())


def test_a_setting_is_still_read_under_the_name_it_had_before():
    entry = controllers()["two-part"]
    chosen = entry.settings({"rest": "inverse-dynamics"})
    assert chosen == entry.settings({"other_joints": "inverse-dynamics"}) != entry.settings()
    assert entry.settings({"rest": "inverse-dynamics", "other_joints": "qp"}) == entry.settings()  # the later one
