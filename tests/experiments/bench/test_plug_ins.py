"""What a bench keeps of a controller from outside: its package, what that needs, and all of its code."""

import sys

import pytest

from surefoot.control.registry import ENTRY_POINT_GROUP, forget_controllers
from surefoot.experiments.bench.bench import BenchRequest, plan_bench
from surefoot.experiments.bench.fingerprint import code_fingerprint, controller_fingerprint, plug_in

ENTRY = """
from surefoot.control.registry import ControllerEntry
from surefoot.control.controllers.soft_qp import SoftQP
from visiting.law import GAIN

entry = ControllerEntry("visitor", "a visitor", SoftQP, {"com_stiffness": GAIN})
"""


def distribution(folder, name, version, *requires, points=""):
    info = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir(exist_ok=True)
    needs = "".join(f"Requires-Dist: {text}\n" for text in requires)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n{needs}")
    (info / "entry_points.txt").write_text(points)


@pytest.fixture
def install(tmp_path, monkeypatch):
    """A package of two modules, which needs a solver, which needs a library, by an extra of ours; gone afterwards."""
    monkeypatch.syspath_prepend(str(tmp_path))

    def forget():
        for name in [name for name in sys.modules if name.partition(".")[0] == "visiting"]:
            del sys.modules[name]
        forget_controllers()

    def put(gain="30.0", solver="2.0"):
        package = tmp_path / "visiting"
        package.mkdir(exist_ok=True)
        (package / "__init__.py").write_text("")
        (package / "law.py").write_text(
            f"GAIN = {gain}  # changes of the same length in the same second: mind caches\n"
        )
        (package / "entry.py").write_text(ENTRY)
        for old in tmp_path.glob("some_solver-*"):
            (old / "METADATA").unlink()
            (old / "entry_points.txt").unlink()
            old.rmdir()
        distribution(tmp_path, "some-solver", solver, "some-library>=1")
        distribution(tmp_path, "some-library", "1.5", "some-solver", "not-installed-at-all")
        distribution(
            tmp_path, "surefoot", "9", "numpy", "some-solver>=2; extra == 'solving'", "joblib; extra == 'other'"
        )
        points = f"[{ENTRY_POINT_GROUP}]\nvisitor = visiting.entry:entry\n"
        distribution(tmp_path, "visiting-controller", "1.2", "surefoot[solving]>=0.1", points=points)
        forget()

    yield put
    monkeypatch.undo()
    forget()


def test_ours_have_no_package_and_the_fingerprint_of_our_code():
    assert plug_in("two-part") is None
    assert controller_fingerprint("two-part") == code_fingerprint()
    assert plan_bench(BenchRequest(controllers="two-part", families=("tilt",), quick=True)).manifest()["plug_ins"] == {}


def test_the_manifest_has_package_versions_and_fingerprint_of_a_controller_from_outside(install):
    install()
    request = BenchRequest(controllers="two-part,visitor,visitor+zmp_margin=0.9", families=("tilt",), quick=True)
    bench = plan_bench(request)
    assert bench.manifest()["plug_ins"] == {
        "visitor": {
            "package": "visiting-controller", "version": "1.2",
            "requires": {"some-library": "1.5", "some-solver": "2.0"}, "code": controller_fingerprint("visitor"),
        }
    }  # fmt: skip
    codes = {cell.controller: cell.code for cell in bench.cells}
    assert codes["visitor"] != codes["two-part"] == code_fingerprint()


def test_the_fingerprint_covers_all_code_of_the_package_and_what_it_needs(install):
    found = []
    for changes in ({}, {}, {"gain": "31.0"}, {"solver": "2.1"}):
        install(**changes)
        found.append(controller_fingerprint("visitor"))
    assert found[0] == found[1]
    assert len(set(found)) == 3
    brought = plug_in("visitor")
    assert brought is not None and [file.name for file in brought.files] == ["__init__.py", "entry.py", "law.py"]
