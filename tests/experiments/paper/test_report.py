"""The report of a reduced set of runs: whole pictures, numbers that ``surefoot run`` gives, readable alone."""

import json
import re
import shlex
from pathlib import Path
from xml.etree import ElementTree

import matplotlib.image
import numpy as np
import pytest

from surefoot.cli.main import main
from surefoot.experiments.paper.captions import FIGURES
from surefoot.experiments.paper.make_report import CLAIMS
from surefoot.experiments.paper.plan import SWING, full_plan
from surefoot.experiments.paper.tables import result_cells
from surefoot.experiments.runs.cases import Case
from surefoot.experiments.runs.table_file import read_parquet
from surefoot.experiments.scenario.scenario import parse_change, shipped_scenarios

ROOT = Path(__file__).resolve().parents[3]
# What may differ between two runs: timing, and the commit when somebody commits in between
MAY_DIFFER = {"tick_us_median", "tick_us_p99", "real_time_factor", "git_commit"}


def run_from_the_command_line(command: str, capsys: pytest.CaptureFixture[str]) -> dict:
    main([*shlex.split(command)[1:], "--json"])
    return json.loads(capsys.readouterr().out)


def agree(one: dict, other: dict) -> bool:
    return all(one[key] == other[key] for key in one.keys() - MAY_DIFFER)


def test_figures_are_drawn_as_png_and_svg(quick_report):
    assert {"figure_1", *(f"figure_{n}" for n in range(5, 10))} <= {figure.name for figure in FIGURES}
    for figure in FIGURES:
        picture = matplotlib.image.imread(quick_report.folder / f"{figure.name}.png")
        assert picture.shape[1] == pytest.approx(1296, abs=5), "as wide as a page"
        inked = (picture[..., :3].min(axis=2) < 0.5).mean()
        assert 0.002 < inked < 0.5, f"{figure.name}: {100 * inked:.1f} % of it is dark"
        assert len(list(ElementTree.parse(quick_report.folder / f"{figure.name}.svg").iter())) > 50


def test_report_holds_every_figure_and_every_claim(quick_report):
    text = (quick_report.folder / "report.md").read_text(encoding="utf-8")
    for figure in FIGURES:
        assert f"]({figure.name}.png)" in text
    for claim, judgement in zip(CLAIMS, quick_report.judged, strict=True):
        assert f"| {claim.text} |" in text
        assert f"**{judgement.verdict}**" in text
    assert "calibrated" in text


def test_html_can_be_read_alone(quick_report):
    text = (quick_report.folder / "report.html").read_text(encoding="utf-8")
    sources = re.findall(r'<img src="([^"]{0,40})', text)
    assert len(sources) == len(FIGURES)
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    assert "<table>" in text
    assert "<script" not in text


def test_report_knows_nothing_of_the_machine(quick_report):
    for name in ("report.md", "report.html", "results.json"):
        text = (quick_report.folder / name).read_text(encoding="utf-8")
        assert str(quick_report.folder) not in text
        assert not re.search(r"(?<![\w.])/(home|root|work|tmp|usr)/", text)


def test_progress_goes_from_nothing_to_all(quick_report):
    done = [part for _, part in quick_report.steps]
    assert done == sorted(done)
    assert done[-1] == 1.0


@pytest.mark.parametrize(("scenario", "controller"), [(SWING, "two-part"), ("paper_figure1_stone", "optimization")])
def test_numbers_are_those_of_surefoot_run(scenario, controller, quick_report, capsys):
    case = next(c for c in quick_report.plan.cases if (c.scenario, c.row) == (scenario, controller))
    found = run_from_the_command_line(case.command, capsys)
    listed = json.loads((quick_report.folder / "results.json").read_text(encoding="utf-8"))["runs"]
    assert agree(found, next(entry for entry in listed if entry["command"] == case.command))
    text = (quick_report.folder / "report.md").read_text(encoding="utf-8")
    assert f"| {' | '.join(result_cells(scenario, case.row, found))} |" in text
    assert case.command in text


def test_raw_data_hold_every_tick_and_how_to_repeat_it(quick_report):
    case = quick_report.plan.cases[0]
    columns, about = read_parquet(quick_report.folder / "raw" / "runs" / f"{case.slug}.parquet")
    assert about["command"] == case.command
    assert np.diff(columns["time_s"]) == pytest.approx(0.001, abs=1e-9)
    assert len(columns["time_s"]) == 1000
    drawn = quick_report.plan.cases + quick_report.plan.told
    assert len(list((quick_report.folder / "raw" / "runs").glob("*.parquet"))) == len(drawn)
    assert (quick_report.folder / "raw" / "prediction.parquet").is_file()
    sweep, _ = read_parquet(quick_report.folder / "raw" / "gain_sweep.parquet")
    assert sweep["command"] == [case.command for case in quick_report.plan.sweep]
    steps, _ = read_parquet(quick_report.folder / "raw" / "step_onto_stone.parquet")
    assert steps["command"] == [case.command for case in quick_report.plan.told + quick_report.plan.steps]


def test_every_case_names_a_shipped_scenario_and_its_command_says_it_all():
    plan = full_plan()
    for case in plan.all_cases:
        assert case.scenario in shipped_scenarios()
        words = shlex.split(case.command)
        sets = tuple(parse_change(words[i + 1]) for i, word in enumerate(words) if word == "--set")
        assert Case(words[2], words[4], sets) == case


def test_what_cannot_be_written_is_one_clear_line(tmp_path, capsys):
    occupied = tmp_path / "file"
    occupied.write_text("")
    for command in ("figures", "ablate"):
        with pytest.raises(SystemExit) as stopped:
            main([command, "--out", str(occupied)])
        assert stopped.value.code == 2
        assert "--out" in capsys.readouterr().err
        with pytest.raises(SystemExit) as stopped:
            main([command, "--out", str(tmp_path / "new"), "--workers", "0"])
        assert stopped.value.code == 2
        assert "--workers" in capsys.readouterr().err


@pytest.mark.slow
def test_whole_report_agrees_with_surefoot_run(tmp_path, capsys):
    main(["figures", "--out", str(tmp_path)])
    capsys.readouterr()
    text = (tmp_path / "report.md").read_text(encoding="utf-8")
    listed = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))["runs"]
    plan = full_plan()
    assert [entry["command"] for entry in listed] == [case.command for case in plan.all_cases]
    for case, entry in list(zip(plan.cases, listed, strict=False))[::4]:
        found = run_from_the_command_line(case.command, capsys)
        assert agree(found, entry), case.command
        assert f"| {' | '.join(result_cells(case.scenario, case.row, found))} |" in text
