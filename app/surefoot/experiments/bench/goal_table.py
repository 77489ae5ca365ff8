"""The figures that walks are to reach as a table: on the terminal, on a bench's page and in the documents."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from surefoot.experiments.bench.share_table import ended_text, steps_text
from surefoot.experiments.bench.statistics import share_interval
from surefoot.experiments.bench.walk_families import GROUND_BY_SEED
from surefoot.experiments.bench.words import table_header, table_line

TITLE = "Figures to reach: runs that came through [95 % interval], and what ended the others"
_HOW = (
    "Bold: the share that came through reaches the bar. Wilson's interval: where a seed draws the ground (stones, "
    "tiles, place of a ledge) each is a trial of its own, elsewhere all seeds of a case are one."
)


def goals_reached(ranking: Mapping[str, Any], manifest: Mapping[str, Any]) -> list[str]:
    """The section of a bench's page; nothing to say where no figures were to be reached."""
    if not manifest.get("goals"):
        return []
    how = " ".join([_HOW, *steps_text(ranking["shares"])])
    return [f"## {TITLE}", "", how, "", *goal_lines(ranking, manifest), ""]


def goal_lines(ranking: Mapping[str, Any], manifest: Mapping[str, Any]) -> list[str]:
    """The table itself: a line a figure, a column a controller, in the order they were asked for."""
    shares = {(share["family"], share["case"], share["controller"]): share for share in ranking["shares"]}
    names = list(dict.fromkeys(share["controller"] for share in ranking["shares"]))
    lines = table_header("what", "bar", *names)
    for goal in manifest["goals"]:
        cells = [_cell([shares[family, case, name] for family, case in goal["cases"]], goal["bar"]) for name in names]
        lines.append(table_line(goal["what"], "all" if goal["bar"] == 1.0 else f">= {100 * goal['bar']:.0f} %", *cells))
    return lines


def _cell(shares: Sequence[Mapping[str, Any]], bar: float) -> str:
    """What one controller came to, over all cases of a figure."""
    completed, played = (sum(share[name] for share in shares) for name in ("completed", "seeds"))
    trials = sum(share["seeds"] if share["family"] in GROUND_BY_SEED else 1 for share in shares)
    low, high = share_interval(completed, played, trials)
    came = f"{completed}/{played}"
    text = f"{f'**{came}**' if completed >= bar * played else came} [{low:.2f}, {high:.2f}]"
    ended: Counter[str] = Counter()
    for share in shares:
        ended.update(share["ended"])
    stopped = sum(share["ankle_stop"] for share in shares)
    if not ended:
        return text
    return f"{text} {ended_text({'ended': dict(ended.most_common()), 'ankle_stop': stopped})}"
