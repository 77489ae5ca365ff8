"""Which walks and steps are survived, as a table: on the terminal and in the page about a bench."""

from collections.abc import Mapping, Sequence
from typing import Any

from surefoot.experiments.bench.words import number_text, table_header, table_line, unit_text

TITLE = "Walks completed and pushes caught, of all seeds [95 % interval of the share]"
COLUMNS = ("family", "case", "controller", "level", "survived", "what ended the others")
SHARES = (
    "Levels that were played with every seed. Wilson's interval: where a seed draws the ground (stones, tiles, place "
    "of a ledge) each is a trial of its own, elsewhere all seeds of a case are one."
)


def walks_completed(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """Which share of the seeds is survived; nothing to say where nobody steps."""
    if not found:
        return []
    header = table_header(*COLUMNS)
    lines = [table_line(*share_cells(entry)) for entry in found]
    return [f"## {TITLE}", "", " ".join([SHARES, *steps_text(found)]), "", *header, *lines, ""]


def steps_text(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """What J_cap1 is, with reach and landing time of its step; nothing where no level is a share of it."""
    steps = dict.fromkeys(share["step"] for share in found if share["step"])
    return [f"J_cap1 is what one step can catch: up to {step}." for step in steps]


def share_cells(share: Mapping[str, Any]) -> tuple[str, ...]:
    """A line of the table of walks: family, case, controller, level, share, what ended the others."""
    low, high = share["interval"]
    ended = ", ".join(f"{cause} {count}" for cause, count in share["ended"].items())
    level = f"{number_text(share['level'], share['unit'])} {unit_text(share['unit'])}"
    if share["bound_ns"] is not None:
        level += f" of {share['bound_ns']:.1f} N s"
    came = f"{share['completed']}/{share['seeds']} [{low:.2f}, {high:.2f}]"
    return share["family"], share["case"], share["controller"], level, came, ended or "-"
