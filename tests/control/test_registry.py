"""Controllers by name: ours, those that an installed package brings, and clear words about all others."""

import sys
from pathlib import Path

import pytest

from surefoot.control.registry import ENTRY_POINT_GROUP, ControllerEntry, controller_named, controllers
from surefoot.errors import InvalidInput

OURS = ["two-part", "optimization", "soft-qp", "two-part-literal"]

PLUGIN = """
from surefoot.control.registry import ControllerEntry
from surefoot.control.controllers.soft_qp import SoftQP

entry = ControllerEntry({name!r}, "a visitor", SoftQP, {{"com_stiffness": 30.0}})
nothing = "not an entry"
"""


@pytest.fixture
def install(tmp_path: Path, monkeypatch):
    """Put a distribution with one entry point on the path, as pip would; gone again after the test."""

    def put(target: str = "entry", name: str = "visitor") -> None:
        (tmp_path / "visiting_controller.py").write_text(PLUGIN.format(name=name))
        info = tmp_path / "visiting_controller-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: visiting-controller\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(f"[{ENTRY_POINT_GROUP}]\nvisitor = visiting_controller:{target}\n")
        monkeypatch.syspath_prepend(str(tmp_path))
        controllers.cache_clear()

    yield put
    monkeypatch.undo()
    sys.modules.pop("visiting_controller", None)
    controllers.cache_clear()


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
    install()
    assert list(controllers())[:4] == OURS
    entry = controller_named("visitor")
    assert isinstance(entry, ControllerEntry)
    assert entry.settings().com_stiffness == 30.0


def test_a_controller_of_an_installed_package_runs(install, simulate):
    install()
    simulation = simulate("visitor")
    for _ in range(20):
        assert simulation.tick().fall_cause is None
    assert type(simulation.controller).__name__ == "SoftQP"


def test_an_entry_point_that_is_no_entry_is_refused_by_name(install):
    install(target="nothing")
    with pytest.raises(InvalidInput, match=r"entry point visitor.*ControllerEntry"):
        controllers()


def test_a_name_of_ours_cannot_be_taken(install):
    install(name="soft-qp")
    with pytest.raises(InvalidInput, match="a name of its own"):
        controllers()


def test_a_setting_is_still_read_under_the_name_it_had_before():
    entry = controllers()["two-part"]
    chosen = entry.settings({"rest": "inverse-dynamics"})
    assert chosen == entry.settings({"other_joints": "inverse-dynamics"}) != entry.settings()
    assert entry.settings({"rest": "inverse-dynamics", "other_joints": "qp"}) == entry.settings()  # the later one
