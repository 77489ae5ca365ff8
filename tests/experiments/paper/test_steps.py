"""Steps onto a stone: which are run, what is claimed of them, and how they are drawn."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from surefoot.experiments.paper.claims import ClaimVerdict, judge
from surefoot.experiments.paper.claims_on_steps import STEP_CLAIMS
from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import (
    STEP_VARIANTS,
    STEPPERS,
    STONE_HEIGHTS_M,
    TOLD,
    full_plan,
    shortened,
    step_case,
)
from surefoot.experiments.paper.steps import (
    COMPLETED,
    ROLL,
    UNFINISHED,
    alone_on_stone,
    completed,
    ending,
    lifts_after_s,
    step_table,
    time_at_stop_s,
    variant_table,
)
from surefoot.experiments.plots.step_in_time import draw_step_in_time
from surefoot.experiments.plots.steps import draw_steps
from surefoot.experiments.runs.cases import CaseResult
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.experiments.scenario.step_onto_stone import NO_STONE, PLACES, SCENE
from surefoot.robot.description import load_robot

INEVITABLE, KEPT, CARRIES, IT_IS_THE_LAW, TORQUES, LIMITS = range(len(STEP_CLAIMS))
LAW = ("two-part", "two-part-literal")


def onto_a_stone(case) -> bool:
    return case.scenario == SCENE and load_scenario(SCENE, dict(case.changes)).stones[0].y_m < 0.5


def verdicts(findings) -> list[ClaimVerdict]:
    return [judgement.verdict for judgement in judge(STEP_CLAIMS, findings)]


def test_every_stone_is_stepped_onto_once_by_everyone_and_flat_ground_too():
    plan = full_plan()
    runs = plan.told + plan.steps
    assert len(set(runs)) == len(runs)
    wanted = [step_case(p, h, c) for p in PLACES for h in STONE_HEIGHTS_M for c in STEPPERS]
    wanted += [step_case("outer", h, c) for h in STONE_HEIGHTS_M for c in STEP_VARIANTS]
    wanted += [step_case(NO_STONE, 0.0, c) for c in STEPPERS]
    assert len(wanted) == 112
    assert set(runs) == set(wanted)
    assert [onto_a_stone(case) for case in plan.told] == [True] * len(STEPPERS)


def test_a_quick_look_steps_onto_one_stone_only():
    quick = shortened(full_plan(), 1.0)
    assert (*quick.places, *quick.heights_m) == TOLD
    assert len(quick.told + quick.steps) == 2 * len(STEPPERS)
    assert all(("duration_s", 1.0) in case.changes for case in quick.all_cases)


def test_what_is_told_in_time_is_the_shipped_scenario():
    for case in full_plan().told:
        assert load_scenario(SCENE, dict(case.changes)) == load_scenario(SCENE)


@pytest.mark.parametrize(
    ("falls", "expected"),
    [
        pytest.param(
            lambda case: case.controller not in LAW,
            {INEVITABLE: "reproduced", KEPT: "reproduced", CARRIES: "reproduced", IT_IS_THE_LAW: "reproduced"},
            id="as the paper has it",
        ),
        pytest.param(
            lambda case: False,
            {INEVITABLE: "not reproduced", KEPT: "reproduced", CARRIES: "not reproduced"},
            id="nobody falls",
        ),
        pytest.param(
            onto_a_stone,
            {INEVITABLE: "reproduced", KEPT: "not reproduced", CARRIES: "not reproduced"},
            id="everybody falls",
        ),
        pytest.param(
            lambda case: case == step_case("heel", 0.01, ("two-part", ())),
            {INEVITABLE: "not reproduced", KEPT: "not reproduced", CARRIES: "not reproduced"},
            id="one fall of the law",
        ),
        pytest.param(
            lambda case: onto_a_stone(case) and case.controller != "two-part",
            {KEPT: "not reproduced", CARRIES: "partly", IT_IS_THE_LAW: "partly"},
            id="the printed law falls too",
        ),
        pytest.param(
            lambda case: onto_a_stone(case) and case.controller == "optimization",
            {INEVITABLE: "not reproduced", CARRIES: "reproduced", IT_IS_THE_LAW: "not reproduced"},
            id="the soft QP does as well",
        ),
    ],
)
def test_verdicts_follow_from_who_falls(falls, expected, invented_findings):
    found = verdicts(invented_findings(falls))
    assert {claim: str(found[claim]) for claim in expected} == expected


def with_roll(findings: Findings, roll_rad: float) -> Findings:
    results = []
    for result in findings.results:
        table = result.table.copy()
        table[:, result.columns.index(f"angle_{ROLL}_rad")] = roll_rad
        results.append(replace(result, table=table))
    return Findings(findings.plan, results, findings.predictions, findings.static_case)


def test_limits_are_attained_where_the_ankle_is_at_its_stop(invented_findings):
    findings, stop = invented_findings(lambda case: False), load_robot("bip").joint_named(ROLL).upper_rad
    assert verdicts(with_roll(findings, stop + 0.005))[LIMITS] is ClaimVerdict.REPRODUCED
    assert verdicts(with_roll(findings, stop - 0.005))[LIMITS] is ClaimVerdict.NOT
    assert verdicts(with_roll(findings, -stop - 0.005))[LIMITS] is ClaimVerdict.NOT, "outer edge down: another stop"


def with_ticks_without_a_solution(findings: Findings, ticks: dict[str, int]) -> Findings:
    results = []
    for result in findings.results:
        found = ticks.get(result.case.controller, 0)
        summary = {**result.summary, "qp_infeasible_ticks": found, "fallback_ticks": found}
        results.append(replace(result, summary=summary))
    return Findings(findings.plan, results, findings.predictions, findings.static_case)


@pytest.mark.parametrize(
    ("ticks", "verdict"),
    [
        ({"optimization": 300}, "reproduced"),
        ({"optimization": 300, "two-part": 1}, "partly"),
        ({"two-part": 1, "two-part-literal": 1}, "not reproduced"),
    ],
)
def test_torques_throughout_where_no_tick_is_without_a_solution(ticks, verdict, invented_findings):
    findings = invented_findings(lambda case: onto_a_stone(case) and case.controller == "optimization")
    assert str(verdicts(with_ticks_without_a_solution(findings, ticks))[TORQUES]) == verdict


def test_a_baseline_that_never_falls_is_not_unable(invented_findings):
    findings = with_ticks_without_a_solution(invented_findings(lambda case: False), {"optimization": 300})
    assert verdicts(findings)[TORQUES] is ClaimVerdict.PARTLY


def test_time_at_the_stop_counts_ticks():
    stop = load_robot("bip").joint_named(ROLL).upper_rad
    rolls = np.array([[0.0], [stop + 0.001], [stop + 0.002], [stop - 0.001]])
    assert time_at_stop_s(CaseResult(full_plan().told[0], {}, (f"angle_{ROLL}_rad",), rolls)) == pytest.approx(0.002)


def forces(left_n: list[float], right_n: list[float]) -> CaseResult:
    columns = ("time_s", "force_left_n", "force_right_n")
    table = np.column_stack((0.1 * np.arange(len(left_n)), left_n, right_n))
    return CaseResult(full_plan().told[0], {}, columns, table)


def test_the_other_foot_lifts_after_the_one_that_landed_has_touched():
    on_both_first = forces([500, 500, 0, 0, 300, 600, 1000, 1000, 500], [500, 0, 1000, 1000, 700, 400, 0, 0, 500])
    assert alone_on_stone(on_both_first).nonzero()[0].tolist() == [6, 7]
    assert lifts_after_s(on_both_first) == pytest.approx(0.2)
    assert lifts_after_s(forces([500, 0, 0, 400], [500, 1000, 1000, 600])) is None
    assert lifts_after_s(forces([500, 500], [0, 0])) is None, "it was never lifted"


@pytest.mark.parametrize(
    ("summary", "end"),
    [
        ({"fell": False, "walk_completed": True, "fall_first_cause": None}, COMPLETED),
        ({"fell": False, "walk_completed": False, "fall_first_cause": None}, UNFINISHED),
        ({"fell": True, "walk_completed": False, "fall_first_cause": "tipped_sole"}, "tipped_sole"),
    ],
)
def test_how_a_step_ended(summary, end):
    assert ending(CaseResult(full_plan().told[0], summary, (), None)) == end


@pytest.fixture
def two_part_loses_heel_stones(invented_findings) -> Findings:
    lost = [step_case("heel", height_m, ("two-part", ())) for height_m in STONE_HEIGHTS_M[2:]]
    return invented_findings(lambda case: case in lost)


def test_the_table_has_every_cell(two_part_loses_heel_stones):
    f = two_part_loses_heel_stones
    lines = step_table(f).splitlines()[2:]
    assert len(lines) == len(PLACES) * len(STEPPERS)
    fall = "**late landing** 2.00 s"
    assert f"| heel | `two-part` | completed | completed | {' | '.join([fall] * 4)} | 2/6 |" in lines
    assert sum("late landing" in line for line in lines) == 1
    assert completed(f, ("two-part", ()), ("heel",)) == {("heel", h) for h in STONE_HEIGHTS_M[:2]}
    assert sum(line.startswith("| outer |") for line in variant_table(f).splitlines()) == len(STEP_VARIANTS)


def test_the_figure_has_every_cell(two_part_loses_heel_stones, tmp_path):
    draw_steps(two_part_loses_heel_stones, tmp_path)
    assert (tmp_path / "step_onto_stone.png").stat().st_size > 10_000
    words = "".join(ElementTree.parse(tmp_path / "step_onto_stone.svg").getroot().itertext())
    assert words.count("✓") == 4 * 24 - 4
    assert words.count("landing") == 4
    for title in ("optimization: 24 of 24", "two-part: 20 of 24", "soft-qp: 24 of 24"):
        assert title in words


def test_the_step_in_time_names_every_end(invented_findings, tmp_path):
    told = full_plan().told[0]
    draw_step_in_time(invented_findings(lambda case: case == told), tmp_path)
    assert (tmp_path / "step_in_time.png").stat().st_size > 10_000
    words = "".join(ElementTree.parse(tmp_path / "step_in_time.svg").getroot().itertext())
    assert words.count("falls at 2.00 s") == 1
    assert words.count("late landing") == 1
    assert words.count("completed") == len(STEPPERS) - 1
