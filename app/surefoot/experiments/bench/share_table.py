"""Which walks are completed, as a table: on the terminal and in the page about a bench."""

from collections.abc import Mapping, Sequence
from typing import Any

from surefoot.experiments.bench.words import number_text, table_header, table_line, unit_text

SHARES = (
    "Levels that were played with every seed. Wilson's interval: where a seed draws the ground (stones, tiles, place "
    "of a ledge) each is a trial of its own, elsewhere all seeds of a case are one."
)


def walks_completed(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """Which share of the seeds is completed; nothing to say where nobody walks."""
    if not found:
        return []
    header = table_header("family", "case", "controller", "level", "completed", "what ended the others")
    lines = [table_line(*share_cells(entry)) for entry in found]
    return ["## Walks completed, of all seeds [95 % interval of the share]", "", SHARES, "", *header, *lines, ""]


def share_cells(share: Mapping[str, Any]) -> tuple[str, ...]:
    """A line of the table of walks: family, case, controller, level, share, what ended the others."""
    low, high = share["interval"]
    ended = ", ".join(f"{cause} {count}" for cause, count in share["ended"].items())
    level = f"{number_text(share['level'], share['unit'])} {unit_text(share['unit'])}"
    came = f"{share['completed']}/{share['seeds']} [{low:.2f}, {high:.2f}]"
    return share["family"], share["case"], share["controller"], level, came, ended or "-"
