"""The command: bad input is one line and exit code 2; every stored scenario replays to the same outcome."""

import dataclasses
import functools
import json
import math

import pytest

from surefoot.cli.bench_tables import print_cases, print_crashes, print_ledger, print_ranking
from surefoot.cli.main import main
from surefoot.experiments.bench.cell_runner import run_cell
from surefoot.experiments.bench.criteria import COM_ERROR_M, Survival
from surefoot.experiments.bench.episode import Episode
from surefoot.experiments.bench.ranking import beyond_bound, crashed, not_adding_up
from surefoot.experiments.bench.store import MANIFEST, RANKING, read_table
from surefoot.experiments.scenario.bounds import push_bound
from surefoot.resources import resource_folder
from tests.support.plug_ins import installed, put_failing_controllers


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
        (
            ("--set", "duration_s=3"),
            ["--set", "duration_s", "controller., physics., motors., estimator., sensors., model_error."],
        ),
        (("--set", "controller.com_stiffness=-1"), ["controller.com_stiffness", "0 to 400"]),
        (("--set", "physics.friction=9"), ["physics.friction", "0.01 to 2"]),
        (("--replay", "0"), ["no finished bench"]),
        (("--families", "walks"), ["--families", "swing, stone", "walk-stones"]),
        (("--families", "walk-stones", "--levels", "a"), ["--levels", "must be numbers"]),
        (("--families", "walk-stones", "--levels", "0.02,0.01"), ["--levels", "must be positive and grow"]),
        (("--families", "walk-stones", "--levels", "nan"), ["--levels", "must be positive and grow"]),
        (("--families", "walk-stones,walk-push", "--levels", "0.02"), ["--levels", "walk-push: N s"]),
        (("--families", "walk-stones", "--levels", "0.01,0.3"), ["stones_under_steps.height_m", "0 to 0.1"]),
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


def test_every_stored_scenario_replays_to_the_same_outcome(bench, finished_tiny, tmp_path, capsys):
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

    monkeypatch.setattr("surefoot.experiments.bench.cell_runner.play", broken)
    rows = run_cell(tiny.tiny_bench().cells[0])
    assert {row["outcome"] for row in rows} == {"falls"} and rows[0]["threshold"] == 0.0
    assert crashed(rows) == rows and rows[0]["refusal"] == "ZeroDivisionError: oh"


def test_the_tables_are_printed(finished_tiny, capsys):
    rows = read_table(finished_tiny)
    print_ranking(rows)
    print_cases(rows)
    assert "two-part-literal" in capsys.readouterr().out


LEVELS = (1.05, 1.06)


@pytest.fixture
def one_push_beyond(bench, tiny, monkeypatch, tmp_path):
    """The command on one forward push of two levels beyond the bound, survived with a ground history made by hand."""

    def run(history):
        plan = tiny.tiny_bench(controllers="two-part-literal")
        case = next(cell.case for cell in plan.cells if cell.case.family == "push")
        table = {**case.table, "pushes": [{**case.table["pushes"][0], "direction_deg": 0.0}]}
        cell = dataclasses.replace(plan.cells[0], case=dataclasses.replace(case, table=table, levels=LEVELS))

        def pretend(scenario, controller, **_):
            push = scenario.pushes[0]
            ground = history(push_bound(scenario), push.impulse_ns, begins_s=push.start_s)
            return Episode(Survival("stands", 0.0, 0.0, 0.0), None, None, None, 0.0, 0, ground)

        monkeypatch.setattr(
            "surefoot.experiments.bench.bench.plan_bench", lambda _: dataclasses.replace(plan, cells=(cell,))
        )
        monkeypatch.setattr("surefoot.experiments.bench.cell_runner.play", pretend)
        code, out, _ = bench("--workers", 1, "--out", tmp_path / "bench")
        return code, out, read_table(tmp_path / "bench")

    return run


def test_a_foot_that_slid_is_a_cause_and_no_failure(one_push_beyond, point_mass):
    code, out, rows = one_push_beyond(functools.partial(point_mass, slide_m=0.02))
    assert code == 0
    (row,) = (row for row in rows if row["level"] == LEVELS[1])
    assert f"eta 1.060, its foot slid or rolled: {row['foot_moved_ns']:+.1f} N s" in out
    assert "does not add up" not in out
    assert row["explained"] and row["foot_moved_ns"] > row["excess_ns"] > 0.0


def test_accounts_that_do_not_add_up_end_the_command_with_1(one_push_beyond, point_mass):
    def without_a_force(bound, impulse_ns, **more):
        ground = point_mass(bound, impulse_ns, slide_m=0.02, **more)
        return dataclasses.replace(ground, com_velocity=1.1 * ground.com_velocity + 0.02)

    code, out, rows = one_push_beyond(without_a_force)
    assert code == 1
    assert out.count("does not add up") == len(rows)
    assert f"{rows[0]['ledger_gap_ns']:+.2f} N s of it are in no entry" in out
    assert not rows[0]["explained"]


def test_a_zmp_beyond_the_sole_ends_the_command_with_1(one_push_beyond, point_mass):
    def misplaced(bound, impulse_ns, **more):
        ground = point_mass(bound, impulse_ns, moment_nm=60.0, **more)
        return dataclasses.replace(ground, sole_corners=ground.sole_corners - 0.05 * bound.normal)

    code, out, _ = one_push_beyond(misplaced)
    assert code == 1 and "the ZMP lay beyond the sole" in out


def test_the_result_that_ships_adds_up_and_names_its_causes(capsys):
    rows = read_table(resource_folder("static") / "results" / "bench")
    assert beyond_bound(rows) and not not_adding_up(rows)
    assert {"explained", "unexplained_ns", "ledger_gap_ns"} <= set(rows[0])
    print_ledger(rows)
    printed = capsys.readouterr().out
    assert "two-part-literal, push left, seed 101: eta 1.100, its foot slid or rolled: +10.1 N s" in printed
    assert "no cause found" not in printed


def test_a_controller_that_fails_is_a_fall_that_is_told_and_the_others_go_on(tiny, tmp_path, capsys):
    put_failing_controllers(tmp_path)
    with installed(tmp_path):
        bench = tiny.tiny_bench(controllers="raises,unready,two-part-literal")
        cells = [cell for cell in bench.cells if cell.case.family == "trunk"]
        raises, unready, literal = [run_cell(cell) for cell in cells]
    assert {(row["outcome"], row["fall_cause"]) for row in (*raises, *unready)} == {("falls", "controller_error")}
    assert all(row["refusal"].startswith("controller raises: RuntimeError") for row in raises)
    assert unready[0]["refusal"] == "controller unready: cannot be built (KeyError: 'a file of mine')"
    assert raises[0]["fall_time_s"] == 0.05 and raises[0]["threshold"] == unready[0]["threshold"] == 0.0
    assert "controller_error" not in {row["fall_cause"] for row in literal}
    rows = [*raises, *unready, *literal]
    assert crashed(rows) == [*raises, *unready]
    print_crashes(rows)
    assert "no idea [red] what to do" in " ".join(capsys.readouterr().err.split())
