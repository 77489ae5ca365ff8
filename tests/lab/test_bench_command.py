"""The command: bad input is one line and exit code 2; every stored scenario replays to the same verdict."""

import dataclasses
import json
import math

import pytest

from app.cli import main
from app.experiments.lab.criteria import COM_ERROR_M
from app.experiments.lab.probe import run_cell
from app.experiments.lab.ranking import crashed
from app.experiments.lab.store import MANIFEST, RANKING, read_table
from app.terminal_lab import print_cases, print_ledger, print_ranking


@pytest.fixture
def bench(capsys):
    def call(*arguments):
        try:
            main(["bench", *map(str, arguments)])
            code = 0
        except SystemExit as exit_:
            code = exit_.code
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return call


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--controllers", "magic"), ["controller", "'magic'", "two-part"]),
        (("--controllers", "two-part+gard=false"), ["controller.gard", "unknown setting"]),
        (("--controllers", "two-part+guard"), ["--set", "key=value"]),
        (("--controllers", "two-part,two-part"), ["--controllers", "twice"]),
        (("--families", "jumps"), ["--families", "'jumps'", "swing, stone"]),
        (("--seeds", "0"), ["--seeds", "at least 1"]),
        (("--first-seed", "-1"), ["--first-seed", "negative"]),
        (("--workers", "0"), ["--workers", "at least 1"]),
        (("--set", "duration_s=3"), ["--set", "duration_s", "controller., physics."]),
        (("--set", "controller.com_stiffness=-1"), ["controller.com_stiffness", "0 to 400"]),
        (("--set", "physics.friction=9"), ["physics.friction", "0.01 to 2"]),
        (("--replay", "0"), ["no finished bench"]),
    ],
)
def test_bad_input_is_one_clear_line(bench, tmp_path, arguments, words):
    code, out, err = bench("--quick", "--out", tmp_path / "new", *arguments)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert all(word in err for word in words), err


def test_a_folder_that_is_a_file_is_refused(bench, tmp_path):
    (tmp_path / "file").touch()
    code, _, err = bench("--quick", "--out", tmp_path / "file")
    assert code == 2 and "--out" in err and err.count("\n") == 1


def test_every_stored_scenario_replays_to_the_same_verdict(bench, finished_tiny, tmp_path, capsys):
    rows = read_table(finished_tiny)
    assert {"falls", "unsettled", "refused"} <= {row["outcome"] for row in rows}
    for i, row in enumerate(rows):
        file = tmp_path / f"{i}.toml"
        code, _, err = bench("--out", finished_tiny, "--replay", i, "--to", file)
        assert code == 0 and row["registry_name"] in err
        if row["outcome"] == "refused":
            continue
        main(["run", str(file), "--controller", row["registry_name"], "--json"])
        summary = json.loads(capsys.readouterr().out)
        assert summary["fell"] == (row["outcome"] == "falls")
        assert (summary["fall_cause"] or "") == row["fall_cause"]
        assert (summary["first_limit"] or "") == row["first_limit"]
        if not summary["fell"]:
            assert summary["com_error_max_m"] == pytest.approx(
                row["com_error_m"], rel=1e-12
            )  # shorter than a second: the whole run is judged
            assert (summary["com_error_final_m"] < COM_ERROR_M) or row["outcome"] == "unsettled"


def test_replay_prints_the_scenario_and_refuses_a_row_that_is_not_there(bench, finished_tiny):
    code, out, _ = bench("--out", finished_tiny, "--replay", 0)
    assert code == 0 and out == read_table(finished_tiny)[0]["scenario"]
    code, _, err = bench("--out", finished_tiny, "--replay", 10_000)
    assert code == 2 and "no such row" in err


def test_the_manifest_says_what_made_the_table(finished_tiny):
    manifest = json.loads((finished_tiny / MANIFEST).read_text())
    assert manifest["complete"] is True
    assert {"arguments", "seeds", "commit", "versions", "settings", "machine", "survived"} <= set(manifest)
    assert manifest["settings"]["two-part-literal"]["p_point"] == "ground"


def test_the_ranking_is_kept_as_plain_data(finished_tiny):
    data = json.loads((finished_tiny / RANKING).read_text())
    assert {entry["controller"] for entry in data["ranking"]} == {"two-part-literal", "optimization"}
    assert {family["family"] for family in data["families"]} == {"push", "slope", "trunk", "swing"}


def test_a_posture_out_of_range_refuses_the_level_and_says_why(tiny):
    cell = next(cell for cell in tiny.tiny_bench().cells if cell.case.family == "slope")
    steep = dataclasses.replace(cell, case=dataclasses.replace(cell.case, levels=(12.0,)))
    (row,) = run_cell(steep)
    assert row["outcome"] == "refused" and "posture" in row["refusal"]
    assert math.isnan(row["threshold"]) and not row["survived"]


def test_an_exception_in_a_controller_is_a_fall_that_is_told(tiny, monkeypatch):
    def broken(scenario, controller, **_):
        raise ZeroDivisionError("oh")

    monkeypatch.setattr("app.experiments.lab.probe.play", broken)
    rows = run_cell(tiny.tiny_bench().cells[0])
    assert {row["outcome"] for row in rows} == {"falls"} and rows[0]["threshold"] == 0.0
    assert crashed(rows) == rows and rows[0]["refusal"] == "ZeroDivisionError: oh"


def test_the_tables_are_printed(finished_tiny, capsys):
    rows = read_table(finished_tiny)
    print_ranking(rows)
    print_cases(rows)
    entries = ("angular_momentum_ns", "sole_ns", "foot_moved_ns", "vertical_ns", "ends_ns")
    beyond = {"eta": 1.05, "survived": True, "explained": False, "bound_ns": 58.2, "linear_ns": 13.0, "excess_ns": 2.0,
              "unexplained_ns": 1.9, **dict.fromkeys(entries, 0.1)}  # fmt: skip
    print_ledger([{**rows[0], **beyond}])
    printed = capsys.readouterr().out
    assert "two-part-literal" in printed and "not explained" in printed
