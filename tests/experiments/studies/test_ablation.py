"""The ablation covers every switch, and its table is in the help."""

from dataclasses import fields

import pytest

from surefoot.control.settings import ControllerSettings
from surefoot.experiments.scenario.scenario import shipped_scenarios
from surefoot.experiments.studies.ablation import (
    DEFAULT,
    SCENARIOS,
    Variant,
    ablation_table,
    all_variants,
    column_name,
    run_ablation,
    switch_variants,
    write_ablation,
)
from surefoot.resources import resource_folder

SWITCHES = [f for f in fields(ControllerSettings) if f.metadata.get("group") == "equations"]


@pytest.mark.parametrize("switch", SWITCHES, ids=lambda switch: switch.name)
def test_every_value_of_a_switch_is_tried(switch):
    meta = switch.metadata
    assert meta["kind"] in ("choice", "switch"), "an equation's setting of another kind needs a variant of its own"
    values = set(meta["valid"]) if meta["kind"] == "choice" else {True, False}
    tried = {variant.settings[0][1] for variant in switch_variants() if variant.settings[0][0] == switch.name}
    assert tried == values - {switch.default}


def test_switches_are_tried_one_at_a_time_against_the_default():
    default, *_ = all_variants()
    assert default == Variant(DEFAULT)
    for variant in switch_variants():
        alone = len(variant.settings) == 1
        assert alone or variant.note, f"{variant.row} brings companions and does not say so"
        assert variant.controller == DEFAULT or variant.settings[0][0] == "latched"


def test_rows_are_told_apart():
    rows = [variant.row for variant in all_variants()]
    assert len(set(rows)) == len(rows)


def test_scenarios_are_shipped():
    assert set(SCENARIOS) <= set(shipped_scenarios())


def test_a_run_that_the_program_refuses_is_an_outcome():
    planned = next(variant for variant in switch_variants() if ("feedforward", "planned") in variant.settings)
    ((_, _, outcome, summary),) = run_ablation([planned], ["paper_swing_35"], 1)
    assert outcome.kind == "refused"
    assert "leaves the sole" in summary["refused"]


def test_table_and_picture_are_written(tmp_path):
    variants = [Variant(DEFAULT), Variant("optimization", (("latched", True),))]
    results = list(run_ablation(variants, ["paper_swing_35"], 1))
    write_ablation(results, tmp_path / "new")
    text = ablation_table(results).markdown()
    assert ablation_table(results).cells["optimization: latched = true", "swing 35"].kind == "falls"
    assert "| two-part | stands," in text
    assert text in (tmp_path / "new" / "ablation.md").read_text(encoding="utf-8")
    for name in ("ablation.png", "ablation.svg", "ablation.json"):
        assert (tmp_path / "new" / name).stat().st_size > 1000


def test_the_table_in_the_help_has_every_row_and_column():
    text = (resource_folder("static") / "help" / "what_the_law_buys.md").read_text(encoding="utf-8")
    lines = text.splitlines()
    header = next(line for line in lines if line.startswith("| changed setting |"))
    assert [cell.strip() for cell in header.split("|")[2:-2]] == [column_name(scenario) for scenario in SCENARIOS]
    for variant in all_variants():
        assert any(line.startswith(f"| {variant.row} |") for line in lines), f"run surefoot ablate: {variant.row}"


@pytest.mark.slow
@pytest.mark.parametrize("variant", [all_variants()[0], all_variants()[-1]], ids=lambda variant: variant.row)
def test_rows_of_the_help_are_what_the_program_gives(variant):
    text = (resource_folder("static") / "help" / "what_the_law_buys.md").read_text(encoding="utf-8")
    table = ablation_table(list(run_ablation([variant], SCENARIOS, 2)))
    assert table.markdown().splitlines()[-1] in text.splitlines()
