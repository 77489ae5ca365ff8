"""From perfect to all imperfections together: what each one takes, bar by bar."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from surefoot.experiments.plots import style
from surefoot.experiments.price.figures import STEPS
from surefoot.experiments.price.losses import INTERPLAY, Price
from surefoot.experiments.price.variants import NONE, TOGETHER
from surefoot.experiments.price.words import shown, shown_unit

_LINE_IN = 0.21  # height of one bar
_FACTOR = {"m": 1e3}  # to the unit that is shown


def draw_waterfalls(found: Sequence[tuple[str, Sequence[Price]]], folder: Path, name: str) -> None:
    """One panel a figure and controller: each bar begins where the one above it ends.

    Args:
        found: of each panel, its title and its prices from ``perfect`` to ``together``.
        folder: where to write.
        name: of the files.
    """
    columns = min(len(found), 2)
    rows = math.ceil(len(found) / columns)
    most = max(len(prices) for _, prices in found)
    with style.figure(rows * (most * _LINE_IN + 0.9)) as fig:
        panels = fig.subplots(rows, columns, squeeze=False).ravel()
        for i, (ax, (title, prices)) in enumerate(zip(panels, found, strict=False)):
            _draw(ax, prices)
            what, _, controller = title.rpartition(", ")
            ax.set_title(f"{what.rpartition(' [')[0].partition(' (')[0]}\n{controller}", fontsize=8.5)
            if i % columns:
                ax.set_yticklabels([])
        for ax in panels[len(found) :]:
            ax.set_visible(False)
        style.save(fig, folder, name)


def waterfall(prices: Sequence[Price]) -> list[tuple[float, float]]:
    """Where each bar begins and ends: whole bars for ``perfect`` and ``together``, between them what is lost.

    Where nothing is known (NaN) the bar has no length.
    """
    spans, level = [], 0.0
    for price in prices:
        if price.variant in (NONE, TOGETHER):
            level = 0.0 if math.isnan(price.value) else price.value
            spans.append((0.0, level))
        else:
            lost = 0.0 if math.isnan(price.lost) else price.lost
            spans.append((level, level - lost))
            level -= lost
    return spans


def _draw(ax: Axes, prices: Sequence[Price]) -> None:
    factor = _FACTOR.get(prices[0].unit, 1.0)
    spans = factor * np.array(waterfall(prices))
    longest = max(float(spans.max()), 1e-9)
    for y, (price, (begin, end)) in enumerate(zip(prices, spans, strict=True)):
        whole = price.variant in (NONE, TOGETHER)
        colour = style.BLUE if whole else style.GREEN if price.lost < 0.0 else style.VERMILLION
        ax.barh(y, end - begin, left=begin, height=0.68, color=style.GREY if price.variant == INTERPLAY else colour)
        if y + 1 < len(prices):
            ax.plot((end, end), (y - 0.34, y + 1.34), color=style.BLACK, lw=0.5)
        right = max(begin, end)
        if price.interval is not None and not whole:
            half = factor * (price.interval[1] - price.lost)
            ax.plot((end - half, end + half), (y, y), color=style.BLACK, lw=1.0)
            right = max(right, end + half)
        text = shown(price.value, price.unit) if whole else shown(-price.lost, price.unit, sign=True)
        # few seeds give intervals that are wider than the panel: their figure stays inside it
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.5} if right > longest else None
        ax.text(min(right, 1.02 * longest), y, f" {text}", va="center", fontsize=7, bbox=box)
    ax.set_yticks(range(len(prices)), [price.variant for price in prices], fontsize=8)
    ax.set_ylim(len(prices) - 0.4, -0.6)
    ax.set_xlim(min(0.0, float(spans.min())), 1.22 * longest)
    ax.set_xlabel(STEPS if prices[0].unit == STEPS else shown_unit(prices[0].unit))
    ax.grid(axis="y", visible=False)
    ax.set_axisbelow(True)
