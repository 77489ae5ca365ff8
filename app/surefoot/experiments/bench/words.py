"""How levels and tables are written, on the terminal and in the page about a bench."""

from collections.abc import Mapping, Sequence
from typing import Any

MARKS = (
    "`+`: some thresholds lie at the top of the ladder, or no posture reaches further. `<`: not even the lowest level "
    "played was survived; a mean counts that as 0."
)
SHOWN_IN = {
    "m": ("mm", 1e3, 1),
    "s": ("s", 1.0, 0),
    "deg": ("deg", 1.0, 1),
    "N s": ("N s", 1.0, 1),
    "J/J_cap": ("J/J_cap", 1.0, 3),
    "J/J_cap1": ("J/J_cap1", 1.0, 3),
}


def unit_text(unit: str) -> str:
    """The unit that values are shown in."""
    return SHOWN_IN[unit][0]


def number_text(value: float | None, unit: str) -> str:
    """A threshold in the unit it is shown in, without the unit."""
    _, factor, digits = SHOWN_IN[unit]
    assert value is not None
    return f"{factor * value:.{digits}f}"


def spread_text(middle: str, least: str, most: str) -> str:
    """A middle value, and its range where there is one."""
    return middle if least == most else f"{middle} ({least} to {most})"


def threshold_number(value: float | None, unit: str, lowest: float | None) -> str:
    """A threshold as ``number_text``; what is 0 because nothing was survived as ``< lowest level`` (``unheld``)."""
    return number_text(value, unit) if value or lowest is None else f"< {number_text(lowest, unit)}"


def unheld(rows: Sequence[Mapping[str, Any]]) -> float | None:
    """The lowest level played in the cells in which no level was survived; None without such a cell.

    Their threshold is said to be 0, but all that is known is that it lies below that level. Of several cells with
    different lowest levels the highest of these: below that one lie all of them.

    Args:
        rows: of any number of cells of one unit, every level that was played.
    """
    held = {row["cell"] for row in rows if row["survived"]}
    lowest: dict[str, float] = {}
    for row in rows:
        if row["cell"] not in held and row["outcome"] != "refused":
            lowest[row["cell"]] = min(row["level"], lowest.get(row["cell"], row["level"]))
    return max(lowest.values(), default=None)


def table_header(*names: str) -> list[str]:
    """The first two lines of a Markdown table."""
    return [table_line(*names), "|" + "---|" * len(names)]


def table_line(*cells: str) -> str:
    """A line of it."""
    return "| " + " | ".join(cells) + " |"
