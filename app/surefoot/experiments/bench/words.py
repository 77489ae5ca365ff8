"""How levels and tables are written, on the terminal and in the page about a bench."""

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


def table_header(*names: str) -> list[str]:
    """The first two lines of a Markdown table."""
    return [table_line(*names), "|" + "---|" * len(names)]


def table_line(*cells: str) -> str:
    """A line of it."""
    return "| " + " | ".join(cells) + " |"
