"""How a price list is written: the same words on the terminal and on its page."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from surefoot.experiments.bench.imperfections import KIND
from surefoot.experiments.bench.words import number_text, threshold_number, unit_text
from surefoot.experiments.price.figures import STEPS
from surefoot.experiments.price.losses import INTERPLAY, Price
from surefoot.experiments.price.plan import ABOUT
from surefoot.experiments.price.variants import ESTIMATOR, NONE, TOGETHER

COLUMNS = ("imperfection", "what is left", "lost [95 %]", "of perfect", "nothing survived")
HOW = (
    "One imperfection at a time. Lost: against the variant that lacks only this one, seed by seed; of a sensor that is "
    f"perfect sensors read by the same estimator, whose own price is `{ESTIMATOR}`; of all others the true state. "
    f"`{INTERPLAY}`: what all `{TOGETHER}` lose beyond the sum of the lines above. Intervals: Student's t over seeds, "
    "each of which draws noise, biases and errors of the model anew and moves every case a little; none with one seed. "
    "Nothing survived: runs in which not even the weakest level was, or, of walks, that were not completed; in "
    "brackets how many of them without a fall, because G stayed 10 mm or more from where it stood "
    "before (with the true state and the nominal model: from its place) or did not come to rest. "
    "+: some thresholds lie at the top of the ladder and may be higher; <: not even the weakest level was survived "
    "in any run."
)


def shown(value: float, unit: str, *, sign: bool = False) -> str:
    """A figure in the unit it is shown in, without the unit; ``sign``: with a + too."""
    if math.isnan(value):
        return "-"
    text = f"{value:.1f}" if unit == STEPS else number_text(value, unit)
    if float(text) == 0.0:
        return text.removeprefix("-")
    return f"+{text}" if sign and value > 0.0 else text


def shown_unit(unit: str) -> str:
    """What that unit is."""
    return STEPS if unit == STEPS else unit_text(unit)


def title(price: Price, figures: Sequence[Mapping[str, Any]]) -> str:
    """What a table of prices is about."""
    what = next(figure["what"] for figure in figures if figure["family"] == price.family)
    return f"{what} [{shown_unit(price.unit)}], {price.controller}"


def cells(price: Price) -> tuple[str, ...]:
    """One line of it."""
    left = shown(price.value, price.unit)
    if price.unit != STEPS and not math.isnan(price.value):
        left = threshold_number(price.value, price.unit, price.lowest) + ("+" if price.at_top else "")
    nothing = f"{price.nothing}/{price.cells}" + (f" ({price.unsettled})" if price.unsettled else "")
    if price.variant == NONE:
        return price.variant, left, "", "", nothing
    lost = shown(price.lost, price.unit, sign=True)
    if price.interval is not None:
        lost += f" [{', '.join(shown(end, price.unit, sign=True) for end in price.interval)}]"
    share = "-" if math.isnan(price.share) else f"{100.0 * price.share:.1f} %"
    if price.variant == INTERPLAY:
        return price.variant, "", lost, share, ""
    return price.variant, left, lost, share, nothing


def tables(found: Sequence[Price]) -> list[list[Price]]:
    """The prices of each figure and controller."""
    groups: dict[tuple[str, str], list[Price]] = {}
    for price in found:
        groups.setdefault((price.family, price.controller), []).append(price)
    return list(groups.values())


def what_differs(manifest: Mapping[str, Any]) -> dict[str, str]:
    """Imperfection -> its changes in words; of the sensors without the estimator, which all of them have."""
    lines = {line["variant"]: line["changes"] for line in manifest[ABOUT]["lines"]}
    return {
        name: ", ".join(f"`{path} = {value}`" for path, value in changes.items() if path != KIND or name == ESTIMATOR)
        for name, changes in lines.items()
        if name not in (NONE, TOGETHER)
    }
