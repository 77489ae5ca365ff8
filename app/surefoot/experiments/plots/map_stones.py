"""Stones over the sole's outline: how high at each place, one panel a controller."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import Polygon, Rectangle

from surefoot.experiments.maps.data import Spot
from surefoot.experiments.plots import style
from surefoot.geometry.polygon import ConvexPolygon

_STOP_SHOWN_M = 0.03
_TILE_MM = 60.0  # of Bip's stones: for other tiles, texts and limits go with them
_COLOURS = mpl.colormaps["cividis"]


def draw_stone_map(
    found: Mapping[str, Sequence[Spot]],
    sole: ConvexPolygon,
    stops: Mapping[str, float],
    size_m: Sequence[float],
    folder: Path,
    name: str,
) -> None:
    """One tile a place, as large as the stone, in the colour of the highest one survived there.

    Args:
        found: controller -> spots.
        sole: of the stance foot.
        stops: case -> height [m] from which the ankle stands at its stop.
        size_m: length and width of the stones.
        folder: where to write.
        name: of the files.
    """
    known = [spot.threshold for spots in found.values() for spot in spots if not math.isnan(spot.threshold)]
    scale = Normalize(0.0, 1e3 * max(known, default=0.01))
    columns = min(len(found), 2)
    rows = math.ceil(len(found) / columns)
    with style.figure(3.6 * rows + 0.5) as fig:
        panels = fig.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel()
        for ax, (controller, spots) in zip(panels, found.items(), strict=False):
            _draw(ax, spots, sole, scale, stops, size_m)
            ax.set_title(controller)
        for ax in panels[len(found) :]:
            ax.set_visible(False)
        for ax in panels:
            ax.label_outer()
        bar = fig.colorbar(ScalarMappable(scale, _COLOURS), ax=panels.tolist(), shrink=0.8, pad=0.02)
        bar.set_label("highest stone survived [mm]")
        bar.outline.set_visible(False)  # pyright: ignore[reportCallIssue]
        fig.supxlabel(f"stance foot from above, walking direction up; {style.RIGHTWARD}", fontsize=9)
        style.save(fig, folder, name)


def _draw(
    ax: Axes,
    spots: Sequence[Spot],
    sole: ConvexPolygon,
    scale: Normalize,
    stops: Mapping[str, float],
    size_m: Sequence[float],
) -> None:
    length, width = (1e3 * side for side in size_m)
    along, across = length / _TILE_MM, width / _TILE_MM
    style.draw_sole(ax, sole)
    ax.set_xlabel("")
    for spot in spots:
        x, y = -1e3 * spot.place[1], 1e3 * spot.place[0]
        height = 1e3 * spot.threshold
        refused = math.isnan(height)
        fill = style.REFUSED if refused else _COLOURS(scale(height))
        ax.add_patch(
            Rectangle(
                (x - 0.5 * width, y - 0.5 * length), width, length, lw=1.0, edgecolor="white", facecolor=fill, zorder=2
            )
        )
        text = "no" if refused or height <= 0.0 else f"{height:.0f}{'+' if spot.at_top else ''}"
        look: dict[str, Any] = {
            "ha": "center",
            "va": "center",
            "zorder": 3,
            "bbox": {"facecolor": fill, "edgecolor": "none", "pad": 1.0},
            "color": "black" if refused or scale(height) >= 0.55 else "white",
        }
        ax.text(x, y + 6 * along, text, fontsize=11, **look)
        stop = stops.get(spot.case, math.inf)
        if stop <= _STOP_SHOWN_M:
            ax.text(x, y - 17 * along, f"stop {1e3 * stop:.0f}", fontsize=7, **look)
    x, y = style.seen_from_above(sole.vertices, np.zeros(2))
    ax.add_patch(Polygon(np.column_stack((x, y)), fill=False, edgecolor=style.GREY, lw=1.2, ls=(0, (4, 2)), zorder=2.5))
    ax.grid(False)
    ax.set_xlim(-130 * across, 130 * across)
    ax.set_ylim(-160 * along, 210 * along)
