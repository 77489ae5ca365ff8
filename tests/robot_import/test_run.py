"""A robot of one's own in scenarios: it is found from where the file lies, stands, and pages cannot name files."""

import io
import json

import mujoco
import pytest
from mcap.reader import make_reader

from surefoot.cli.main import main
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.scene.robot import link_glb
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.mcap_file import mcap_bytes
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from tests.support.small_biped import LEG, SPHERE_SOLE, bent, biped

POSTURE = bent("small.xml")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "small.xml").write_text(biped(sole=SPHERE_SOLE))
    (tmp_path / "robot.toml").write_text(POSTURE)
    (tmp_path / "stand.toml").write_text('robot = "robot.toml"\nsupport = "left"\nduration_s = 0.3\n')
    return tmp_path


@pytest.mark.parametrize("support", ["left", "double"])
def test_it_stands(folder, support):
    scenario = load_scenario(folder / "stand.toml", {"support": support}, robot_files=True)
    assert scenario.robot == str(folder / "robot.toml")
    summary = run(scenario, "two-part").summary
    assert not summary["fell"], summary
    assert summary["qp_infeasible_ticks"] == 0
    assert summary["com_error_max_m"] < 0.002


def test_roll_before_pitch_and_turned_axes_stand_too(folder):
    legs = [*LEG[:4], ("ankle_roll", "-1 0 0", *LEG[4][2:]), ("ankle_pitch", "0 -1 0", *LEG[5][2:])]
    (folder / "small.xml").write_text(biped(leg=legs))
    (folder / "robot.toml").write_text(POSTURE.replace("ankle_pitch = -0.3", "ankle_pitch = 0.3"))
    summary = run(load_scenario(folder / "stand.toml", robot_files=True), "two-part").summary
    assert not summary["fell"], summary
    assert summary["com_error_max_m"] < 0.002


def test_the_command_takes_the_robot_from_the_working_folder(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    main(["run", "stand_double", "--robot", "robot.toml", "--set", "duration_s=0.02", "--json"])
    summary = json.loads(capsys.readouterr().out)
    assert not summary["fell"]
    assert "left_knee" in summary["torque_peak_nm"]


def test_every_link_can_be_drawn(folder):
    """As the replay of a saved run draws it, material by material; collision shapes and soles stay hidden."""
    robot = load_scenario(folder / "stand.toml", robot_files=True).robot_description()
    model = mujoco.MjModel.from_xml_string(robot.mjcf_xml)
    drawn = [geom for geom in range(model.ngeom) if model.geom_group[geom] < 3]
    assert {model.body(int(model.geom_bodyid[geom])).name for geom in drawn} == {"trunk"}
    assert link_glb(model, drawn).startswith(b"glTF")


def test_mcap_draws_it_as_sticks_from_the_base_to_each_end(folder):
    playback = Playback(load_scenario(folder / "stand.toml", robot_files=True), "two-part")
    for _ in range(5):
        playback.tick()
    description = playback.live.simulation.robot
    chains, feet = description.link_chains, {foot.body for foot in description.feet}
    file = io.BytesIO(mcap_bytes(playback.saved_run()))
    _, _, message = next(iter(make_reader(file).iter_messages(topics=["/scene"])))
    robot = json.loads(message.data)["entities"][0]
    assert robot["id"] == description.name
    assert [len(line["points"]) for line in robot["lines"]] == [len(chain) for chain in chains]
    assert [len(chain) for chain in chains if chain[-1] in feet] == [7, 7]


def test_who_may_not_name_files_is_told_the_names(folder):
    with pytest.raises(InvalidInput, match=r"no such robot.*bip"):
        load_scenario(folder / "stand.toml")
