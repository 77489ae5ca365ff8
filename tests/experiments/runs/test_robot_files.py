"""A saved run names the files of its robot; who reads it is told where they have changed, moved or gone."""

import os
from pathlib import Path

import pytest

import surefoot
from surefoot.cli.main import main
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.robots import sha256_now
from surefoot.robot.model_files import files_sha256, mjcf_files
from tests.support.small_biped import SPHERE_SOLE, biped, write_small_robot

CHANGED = biped(sole=SPHERE_SOLE, joint='range="-1.5 1.5" armature="0.02"')


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    write_small_robot(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def saved(folder) -> Path:
    changes = {"duration_s": 0.01}
    surefoot.run("stand_double", robot="small/robot.toml", changes=changes).save("run.npz")
    return folder / "run.npz"


def test_the_manifest_names_file_and_hash_and_nothing_is_told_of_what_is_unchanged(saved, recwarn, capsys):
    manifest = surefoot.open_run(saved).manifest
    assert manifest["robot"] == str(saved.parent / "small" / "robot.toml")
    assert manifest["robot_sha256"] == sha256_now("small/robot.toml")
    main(["replay", str(saved), "--out", "again.npz"])
    assert not recwarn.list
    assert capsys.readouterr().err == ""


def test_a_change_is_told_everywhere(saved, capsys):
    (saved.parent / "small" / "small.xml").write_text(CHANGED)
    with pytest.warns(UserWarning, match="have changed since: SHA-256 was"):
        surefoot.open_run(saved)
    main(["replay", str(saved), "--out", "again.npz"])
    assert "small/robot.toml have changed since" in capsys.readouterr().err


def test_a_moved_robot_is_found_where_it_is_said_to_be(saved):
    (saved.parent / "small").rename(saved.parent / "moved")
    with pytest.warns(UserWarning, match="cannot be looked at"):
        surefoot.open_run(saved)
    run = surefoot.open_run(saved, robot="moved/robot.toml")
    assert run.manifest["robot"] == run.manifest["scenario"]["robot"] == str(saved.parent / "moved" / "robot.toml")
    main(["replay", str(saved), "--robot", "moved/robot.toml", "--out", "page.html"])
    assert (saved.parent / "page.html").stat().st_size > 10_000
    with pytest.raises(InvalidInput, match="no such robot"):
        surefoot.open_run(saved, robot="nobody")


def test_a_loaded_scenario_takes_no_other_robot():
    with pytest.raises(InvalidInput, match="robot"):
        surefoot.run(surefoot.load_scenario("stand_left"), robot="offset")


def test_the_files_are_all_that_the_mjcf_reads(tmp_path):
    """Includes from the main folder, meshes from ``meshdir``, textures not; a copy elsewhere has the same hash."""
    for place in ("here", "there"):
        (tmp_path / place / "parts").mkdir(parents=True)
        (tmp_path / place / "main.xml").write_text(
            '<mujoco><compiler meshdir="parts"/><include file="parts/legs.xml"/>'
            '<asset><mesh file="a.obj"/><texture file="skin.png"/><hfield file="hill.png"/></asset></mujoco>'
        )
        (tmp_path / place / "parts" / "legs.xml").write_text(
            '<mujocoinclude><include file="parts/feet.xml"/><asset><mesh file="b.obj"/></asset></mujocoinclude>'
        )
        (tmp_path / place / "parts" / "feet.xml").write_text("<mujocoinclude/>")
        for name in ("a.obj", "b.obj", "hill.png"):
            (tmp_path / place / "parts" / name).write_text(name)
    files = mjcf_files(tmp_path / "here" / "main.xml")
    relative = {name: os.path.relpath(file, tmp_path / "here") for name, file in files.items()}
    assert relative == {
        "mjcf": "main.xml",
        "include parts/legs.xml": "parts/legs.xml",
        "include parts/feet.xml": "parts/feet.xml",
        "mesh a.obj": "parts/a.obj",
        "mesh b.obj": "parts/b.obj",
        "hfield hill.png": "parts/hill.png",
    }
    first = files_sha256(files)
    assert files_sha256(mjcf_files(tmp_path / "there" / "main.xml")) == first
    for name, file in files.items():
        before = file.read_bytes()
        file.write_bytes(before + b" ")
        assert files_sha256(files) != first, name
        file.write_bytes(before)
    files["mesh a.obj"].unlink()
    assert files_sha256(files) != first
