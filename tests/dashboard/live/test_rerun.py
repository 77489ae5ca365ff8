"""A saved run is made again from its file alone, to the bit; and where it is not the same, that is said."""

import dataclasses
import json

import numpy as np
import pytest

from surefoot import run
from surefoot.cli.main import main
from surefoot.dashboard.live.rerun import rerun
from surefoot.dashboard.live.rewind import history
from surefoot.dashboard.messages import commands as cmd
from surefoot.errors import SurefootError
from surefoot.experiments.runs.comparison import difference
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.runs.saved_run import SCRIPT, SavedRun


def reopened(kept: SavedRun, folder) -> SavedRun:
    """Written and read: nothing but plain values is left."""
    write_run(kept, folder / "kept.npz")
    return read_run(folder / "kept.npz")


def ticks(playback, count: int) -> None:
    for _ in range(count):
        playback.tick()


@pytest.fixture
def lived(playback):
    """A live run to which everything was done that a page can do."""
    ticks(playback, 40)
    playback.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.006, size_m=0.06, shape="wedge"))
    playback.apply(cmd.PlaceStone(x_m=0.6, y_m=0.5, height_m=0.02, size_m=0.08, shape="half-ball"))
    ticks(playback, 60)
    playback.apply(cmd.ChangeSettings({"com_damping": 14.0}, drag_id=3))
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=4.0))
    ticks(playback, 50)
    playback.apply(cmd.HoldLink(client_id="a", link="trunk", point=(0.0, 0.0, 0.2), target=(0.2, 0.1, 1.4)))
    playback.apply(cmd.MoveStone(number=1, x_m=-0.5, y_m=0.4))
    ticks(playback, 60)
    playback.apply(cmd.SetFriction(0.7))
    playback.apply(cmd.UndoSettings())
    playback.apply(cmd.SetController("soft-qp"))
    ticks(playback, 60)
    playback.apply(cmd.UseSettings(settings={"com_stiffness": 55.0}, label="a preset", controller="two-part"))
    ticks(playback, 30)
    playback.apply(cmd.Seek(0.16))  # before friction and hand-over: the one comes again, the other is forgotten
    playback.apply(cmd.TiltGround(slope_deg=1.0, direction_deg=20.0))
    ticks(playback, 120)
    playback.apply(cmd.LetGo("a"))
    playback.apply(cmd.RemoveLastStone())
    ticks(playback, 20)
    return playback


@pytest.mark.parametrize("suffix", [".npz", ".parquet"])
def test_a_run_of_the_page_is_made_again(lived, tmp_path, capsys, suffix):
    file = tmp_path / f"run{suffix}"
    write_run(lived.saved_run(), file)
    with pytest.raises(SystemExit) as nothing_else:
        main(["rerun", str(file)])
        raise SystemExit(0)
    assert nothing_else.value.code == 0
    assert "equal: stand_left under two-part, 300 ticks" in capsys.readouterr().out


def test_only_what_was_done_is_in_the_script(lived):
    done = [name for _, name, _ in lived.saved_run().manifest[SCRIPT]["done"]]
    assert "SetFriction" in done  # it came again after the fork
    assert "soft-qp" not in done  # the fork forgot it


def test_an_instant_of_the_past_is_saved_as_it_was(lived, tmp_path):
    lived.apply(cmd.Seek(0.1))
    kept = reopened(lived.saved_run(), tmp_path)
    assert len(kept.table) == 100
    assert difference(kept, rerun(kept)) is None


def test_a_start_with_changed_settings_is_remembered(playback, tmp_path):
    playback.apply(cmd.ChangeSettings({"com_stiffness": 80.0}))
    playback.apply(cmd.SetFriction(0.5))
    playback.apply(cmd.Reset())
    ticks(playback, 50)
    kept = reopened(playback.saved_run(), tmp_path)
    assert kept.manifest[SCRIPT]["changes"] == {"com_stiffness": 80.0}
    assert difference(kept, rerun(kept)) is None


@pytest.mark.parametrize(
    ("scenario", "controller"), [("stone_outer_edge", "two-part"), ("swing_inward", "optimization")]
)
def test_a_run_of_the_command_line_is_made_again(tmp_path, capsys, scenario, controller):
    file = str(tmp_path / "run.npz")
    main(["run", scenario, "--controller", controller, "--set", "duration_s=0.3", "--out", file])
    main(["rerun", file])
    assert f"equal: {scenario} under {controller}, 300 ticks" in capsys.readouterr().out


@pytest.fixture(scope="module")
def short() -> SavedRun:
    done = run("stand_left", changes={"duration_s": 0.05})
    return SavedRun(done.columns, done.table, json.loads(json.dumps(done.manifest)))


def test_the_last_digit_is_found(short, tmp_path, capsys):
    table = short.table.copy()
    column = short.columns.index("com_y_m")
    table[30, column] = np.nextafter(table[30, column], 1.0)
    file = tmp_path / "run.npz"
    write_run(SavedRun(short.columns, table, {**short.manifest, "git_commit": "0123abc"}), file)
    with pytest.raises(SystemExit) as end:
        main(["rerun", str(file)])
    assert end.value.code == 1
    printed = capsys.readouterr()
    assert "1 of 50 ticks differ, first at 0.030 s: com_y_m" in printed.out
    assert "commit was 0123abc" in printed.err


def test_fewer_ticks_are_a_difference(short):
    assert difference(short, SavedRun(short.columns, short.table[:-1], short.manifest)) == "49 ticks instead of 50"


def test_the_end_of_a_long_run_is_compared_with_the_end(short):
    assert difference(SavedRun(short.columns, short.table[20:], short.manifest), short) is None
    assert difference(SavedRun(short.columns, short.table[:20], short.manifest), short) is not None


GOOD = {"controller": "two-part", "changes": {}, "ticks": 5, "done": [], "whole": True}
SCRIPTS = {
    "no script": 3,
    "no ticks": {key: value for key, value in GOOD.items() if key != "ticks"},
    "ticks for ever": {**GOOD, "ticks": 10**12},
    "no list": {**GOOD, "done": 7},
    "unknown command": {**GOOD, "done": [[0, "Explode", {}]]},
    "unknown controller": {**GOOD, "controller": "magic"},
    "unknown setting": {**GOOD, "changes": {"x": 1}},
    "a field too many": {**GOOD, "done": [[0, "LetGo", {"client_id": "a", "x": 1}]]},
    "a field too few": {**GOOD, "done": [[0, "PlaceStone", {}]]},
    "a number of another kind": {**GOOD, "done": [[0, "MoveStone", {"number": [0], "x_m": 0.0, "y_m": 0.0}]]},
}


@pytest.mark.parametrize("what", SCRIPTS)
def test_a_script_that_makes_no_sense_is_refused(short, tmp_path, what):
    file = tmp_path / "run.npz"
    write_run(SavedRun(short.columns, short.table, {**short.manifest, SCRIPT: SCRIPTS[what]}), file)
    with pytest.raises(SurefootError) as refused:
        rerun(read_run(file))
    assert "\n" not in str(refused.value)


def test_a_disturbance_that_is_refused_changes_nothing(short, tmp_path):
    """As on the page: it may have come again after a fork, and had nothing to act on."""
    script = {**GOOD, "ticks": 50, "done": [[3, "SetFriction", {"friction": 99.0}], [4, "RemoveStone", {"number": 9}]]}
    kept = reopened(SavedRun(short.columns, short.table, {**short.manifest, SCRIPT: script}), tmp_path)
    assert difference(kept, rerun(kept)) is None


def test_a_run_of_the_page_without_a_script_is_refused(short):
    """Files of earlier versions: the scenario alone does not make that run again."""
    with pytest.raises(SurefootError, match="before it kept what was done"):
        rerun(SavedRun(short.columns, short.table, {**short.manifest, "summary": {}}))


def test_a_run_with_too_much_in_it_says_so(playback, tmp_path, monkeypatch):
    monkeypatch.setattr(history, "MOST_ENTRIES", 3)
    monkeypatch.setattr(history, "HISTORY_TICKS", 100)
    for _ in range(5):
        playback.apply(cmd.SetFriction(0.7))
        ticks(playback, 100)
    kept = reopened(playback.saved_run(), tmp_path)
    assert kept.manifest[SCRIPT]["whole"] is False
    with pytest.raises(SurefootError, match="more was done to that run"):
        rerun(kept)


def test_every_disturbance_survives_the_file():
    """What a command holds is plain values: numbers, texts, and lists of numbers that are tuples again."""
    for name, kind in vars(cmd).items():
        if isinstance(kind, type) and issubclass(kind, cmd.WorldCommand) and dataclasses.is_dataclass(kind):
            for field in dataclasses.fields(kind):
                assert field.type in (float, int, str, tuple[float, float, float]), (name, field.name)
