"""How thresholds and shares are written, on the terminal and on the page alike."""

import math

from app.experiments.lab.statistics import wilson_interval

SHOWN_IN = {"m": ("mm", 1e3, 1), "deg": ("deg", 1.0, 1), "N s": ("N s", 1.0, 1), "J/J_cap": ("J/J_cap", 1.0, 3)}
REFUSED = "refused"  # by the planner, whatever the controller


def unit_text(unit: str) -> str:
    """The unit that values are shown in."""
    return SHOWN_IN[unit][0]


def threshold_text(mean: float | None, worst: float | None, *, at_top: bool, unit: str) -> str:
    """Mean and least of a family's thresholds [``unit``]; a plus where some lie at the top of the ladder."""
    if not (_known(mean) and _known(worst)):
        return REFUSED
    return f"{_number(mean, unit)}{'+' if at_top else ''} ({_number(worst, unit)})"


def range_text(median: float | None, low: float | None, high: float | None, unit: str) -> str:
    """A case's median over seeds, and its range where there is one [``unit``]."""
    if not (_known(median) and _known(low) and _known(high)):
        return REFUSED
    middle, least, most = (_number(value, unit) for value in (median, low, high))
    return middle if least == most else f"{middle} ({least} to {most})"


def share_text(count: int, of: int) -> str:
    """A share with its 95 % Wilson interval."""
    if not of:
        return "-"
    low, high = wilson_interval(count, of)
    return f"{count}/{of} [{low:.2f}, {high:.2f}]"


def _known(value: float | None) -> bool:
    return value is not None and not math.isnan(value)


def _number(value: float | None, unit: str) -> str:
    _, factor, digits = SHOWN_IN[unit]
    assert value is not None
    return f"{factor * value:.{digits}f}"
