"""What ``surefoot ablate`` writes: the table as markdown, as a picture, and every summary."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from surefoot.experiments.studies.ablation import Variant, ablation_table
from surefoot.experiments.studies.outcomes import Outcome

_HEAD = """\
# Ablation

Each row changes one setting of `two-part` (or of the controller named); each column is a shipped scenario. A cell says
how the run ended: the largest distance of the centre of mass from its reference for a run that stands, the time of a
fall, or that the program refused to start it. A star: in some ticks a QP had no solution.
"""


def write_ablation(results: Sequence[tuple[Variant, str, Outcome, dict[str, Any]]], out: Path) -> str:
    """Write ablation.md, .png, .svg and .json into a folder; returns the table."""
    from surefoot.experiments.plots.outcomes import draw_tables

    out.mkdir(parents=True, exist_ok=True)
    table = ablation_table(results)
    text = table.markdown()
    commands = dict.fromkeys(f"- `{variant.case(scenario).command}`" for variant, scenario, *_ in results)
    body = (_HEAD, text, "![The same as a picture](ablation.png)", "## Commands", "\n".join(commands))
    (out / "ablation.md").write_text("\n\n".join(body) + "\n", encoding="utf-8")
    rows = [{"row": variant.row, "scenario": scenario, **summary} for variant, scenario, _, summary in results]
    (out / "ablation.json").write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    draw_tables((table,), out, "ablation", slanted=True)
    return text
