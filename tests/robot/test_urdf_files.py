"""Where the meshes of a URDF are found, and that its hash is that of the URDF and of them."""

import pytest

from surefoot.robot.model_files import files_sha256, model_files
from surefoot.robot.urdf_files import find_mesh, is_urdf
from tests.support.small_urdf import mesh, urdf, write_stl


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("package://robo/meshes/a.stl", "ws/robo/meshes/a.stl"),
        ("package:///robo/meshes/a.stl", "ws/robo/meshes/a.stl"),
        ("model://robo/meshes/a.stl", "ws/robo/meshes/a.stl"),
        ("package://other/a.stl", "ws/other/a.stl"),
        ("package://robo_description/meshes/a.stl", "ws/robo/meshes/a.stl"),
        ("meshes/a.stl", "ws/robo/meshes/a.stl"),
        ("../meshes/a.stl", "ws/robo/meshes/a.stl"),
        ("a.stl", "ws/robo/urdf/a.stl"),
        ("package://far/a.stl", "ros/far/a.stl"),
        ("package://built/a.stl", "ament/share/built/a.stl"),
    ],
)
def test_a_mesh_is_found(tmp_path, monkeypatch, name, place):
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path / 'nothing'}:{tmp_path / 'ros'}")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "ament"))
    file = tmp_path / "ws" / "robo" / "urdf" / "robo.urdf"
    file.parent.mkdir(parents=True)
    write_stl(tmp_path / place)
    found = find_mesh(file, name)
    assert found is not None and found.resolve() == tmp_path / place
    (tmp_path / place).unlink()
    assert find_mesh(file, name) is None


def test_a_whole_path_and_meshdir(tmp_path):
    write_stl(tmp_path / "far" / "a.stl")
    file = tmp_path / "robo" / "robo.urdf"
    file.parent.mkdir()
    whole = tmp_path / "far" / "a.stl"
    assert find_mesh(file, f"file://{whole}") == whole
    assert find_mesh(file, str(whole)) == whole
    assert find_mesh(file, "a.stl") is None
    found = find_mesh(file, "a.stl", "../far")
    assert found is not None and found.resolve() == whole


def test_a_package_of_that_name_goes_before_a_folder_of_another(tmp_path):
    for folder in ("ws/robo", "ws/robo/urdf"):
        write_stl(tmp_path / folder / "meshes" / "a.stl")
    found = find_mesh(tmp_path / "ws" / "robo" / "urdf" / "robo.urdf", "package://robo/meshes/a.stl")
    assert found == tmp_path / "ws" / "robo" / "meshes" / "a.stl"


def test_the_hash_is_that_of_the_urdf_and_of_its_meshes_wherever_they_lie(tmp_path):
    digests = []
    for home in ("here", "there"):
        folder = tmp_path / home / "robo"
        write_stl(folder / "meshes" / "a.stl")
        (folder / "robo.urdf").write_text(urdf(trunk=mesh("visual", "package://robo/meshes/a.stl")))
        files = model_files(folder / "robo.urdf")
        assert list(files) == ["urdf", "mesh package://robo/meshes/a.stl"]
        digests.append(files_sha256(files))
    assert digests[0] == digests[1]
    write_stl(folder / "meshes" / "a.stl", size_m=0.06)
    changed = files_sha256(model_files(folder / "robo.urdf"))
    (folder / "meshes" / "a.stl").unlink()
    assert len({digests[0], changed, files_sha256(model_files(folder / "robo.urdf"))}) == 3


def test_a_urdf_is_known_by_suffix_or_first_element(tmp_path):
    (tmp_path / "a.xml").write_text(urdf())
    (tmp_path / "b.xml").write_text("<mujoco/>")
    (tmp_path / "c.xml").write_text("no XML")
    known = [is_urdf(tmp_path / name) for name in ("a.xml", "b.xml", "c.xml", "gone.xml", "gone.urdf", "x.urdf.xacro")]
    assert known == [True, False, False, False, True, True]
