"""``surefoot robot`` as a person runs it."""

import json

import pytest

from surefoot.cli.main import main
from tests.support.small_biped import LEG, biped


@pytest.fixture
def mjcf(tmp_path, monkeypatch):
    folder = tmp_path / "theirs"
    folder.mkdir()
    (folder / "robot.xml").write_text(biped())
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    return folder / "robot.xml"


def exit_code(*arguments: object) -> int:
    try:
        main([str(argument) for argument in arguments])
    except SystemExit as end:
        return int(end.code or 0)
    return 0


def test_a_robot_that_is_fit_gives_a_report_and_0_and_nothing_is_written(mjcf, tmp_path, capsys):
    before = sorted(tmp_path.rglob("*"))
    assert exit_code("robot", "check", mjcf) == 0
    text = capsys.readouterr().out
    for part in (
        "14 joints",
        "180 x 70 mm",
        "left_ankle_pitch",
        "motor ctrlrange",
        "cond(H)",
        "fit: nothing is in the way",
    ):
        assert part in text
    assert sorted(tmp_path.rglob("*")) == before


def test_json_is_the_whole_report(mjcf, capsys):
    assert exit_code("robot", "check", mjcf, "--json") == 0
    table = json.loads(capsys.readouterr().out)
    assert table["fit"] is True
    assert table["trunk"]["how"].endswith("trunk in robot.toml chooses another")
    assert len(table["joints"]) == table["joint_count"] == 14
    assert [one["support"] for one in table["statics"]] == ["two feet", "left foot", "right foot"]


def test_one_that_is_not_gives_reason_and_remedy_and_1(mjcf, capsys):
    mjcf.write_text(biped(leg=LEG[:5]))
    assert exit_code("robot", "check", mjcf) == 1
    text = capsys.readouterr().out
    assert "legs: five-joint legs" in text
    assert "remedy:" in text
    assert "not fit: 1 in the way" in text


def test_a_file_that_cannot_be_read_gives_one_line_and_2(mjcf, capsys):
    mjcf.write_text("no xml")
    assert exit_code("robot", "check", mjcf) == 2
    error = capsys.readouterr().err
    assert error.startswith("surefoot: robot = ")
    assert error.count("\n") == 1


def test_init_writes_here_what_check_reads_and_never_over_a_file(mjcf, tmp_path, capsys):
    assert exit_code("robot", "init", mjcf) == 0
    written = tmp_path / "here" / "robot.toml"
    text = written.read_text()
    assert 'mjcf = "../theirs/robot.xml"' in text
    assert exit_code("robot", "check", written) == 0
    assert exit_code("robot", "init", mjcf) == 2
    assert "is there already" in capsys.readouterr().err
    assert written.read_text() == text
    assert list(mjcf.parent.iterdir()) == [mjcf]
