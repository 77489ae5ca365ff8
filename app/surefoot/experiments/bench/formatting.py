"""How thresholds and shares are written, on the terminal and on the page alike."""

import math
from collections.abc import Sequence

from surefoot.experiments.bench.statistics import share_interval

SHOWN_IN = {"m": ("mm", 1e3, 1), "deg": ("deg", 1.0, 1), "N s": ("N s", 1.0, 1), "J/J_cap": ("J/J_cap", 1.0, 3)}
REFUSED = "refused"  # by the planner, whatever the controller


def unit_text(unit: str) -> str:
    """The unit that values are shown in."""
    return SHOWN_IN[unit][0]


def threshold_text(mean: float | None, worst: float | None, *, at_top: bool, unit: str) -> str:
    """Mean and least of a family's thresholds [``unit``]; a plus where some lie at the top of the ladder."""
    if not (_known(mean) and _known(worst)):
        return REFUSED
    return f"{number_text(mean, unit)}{'+' if at_top else ''} ({number_text(worst, unit)})"


def range_text(median: float | None, low: float | None, high: float | None, unit: str) -> str:
    """A case's median over seeds, and its range where there is one [``unit``]."""
    if not (_known(median) and _known(low) and _known(high)):
        return REFUSED
    middle, least, most = (number_text(value, unit) for value in (median, low, high))
    return middle if least == most else f"{middle} ({least} to {most})"


def share_text(count: int, of: int, cases: int) -> str:
    """A share with its 95 % interval, the trials being seeds of some cases."""
    if not of:
        return "-"
    low, high = share_interval(count, of, cases)
    return f"{count}/{of} [{low:.2f}, {high:.2f}]"


def score_text(score: float, interval: Sequence[float]) -> str:
    """A score, or a difference of two, with its interval."""
    return f"{score:.3f} [{interval[0]:.3f}, {interval[1]:.3f}]"


INTERVALS = (
    "Intervals are of 95 % and over the cases, as if these were a sample of disturbances of their kind; seeds of "
    "one case are near copies and add no trials of their own. Of a share: Wilson's, with as many trials as there "
    "are cases. Of a score: 10 000 resamples of the cases within each family, each case with all its seeds and for "
    "all controllers at once. An interval of 'behind the first' that reaches 0 says that the order may be chance."
)


def _known(value: float | None) -> bool:
    return value is not None and not math.isnan(value)


def number_text(value: float | None, unit: str) -> str:
    """A threshold in the unit it is shown in, without the unit."""
    _, factor, digits = SHOWN_IN[unit]
    assert value is not None
    return f"{factor * value:.{digits}f}"
