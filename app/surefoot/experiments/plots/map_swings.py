"""Swings: amplitude over duration, what was survived, and where the reference itself leaves the sole."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from surefoot.experiments.maps.data import Spot
from surefoot.experiments.maps.limits import SwingLimits
from surefoot.experiments.plots import style

_MARKS = {
    "stands": ("stands", {"marker": "o", "color": style.BLUE, "s": 34}),
    "unsettled": (
        "does not fall, does not settle",
        {"marker": "D", "facecolor": "none", "edgecolor": style.GREEN, "s": 26},
    ),
    "falls": ("falls", {"marker": "x", "color": style.VERMILLION, "s": 30}),
    "refused": ("cannot be started", {"marker": "_", "color": style.GREY, "s": 40}),
}


def draw_swing_map(
    found: Mapping[str, Mapping[str, Sequence[Spot]]], limits: Mapping[str, SwingLimits], folder: Path, name: str
) -> None:
    """One row a direction, one column a controller.

    Args:
        found: direction -> controller -> spots.
        limits: direction -> where the reference leaves the sole.
        folder: where to write.
        name: of the files.
    """
    columns = max(len(by_controller) for by_controller in found.values())
    with style.figure(2.1 * len(found) + 1.0) as fig:
        panels = fig.subplots(len(found), columns, squeeze=False, sharex=True, sharey=True)
        highest = max(level for by in found.values() for spots in by.values() for s in spots for level, _ in s.levels)
        for ax, controller in zip(panels[0], next(iter(found.values())), strict=False):
            ax.set_title(controller, fontsize=9.0 if columns < 4 else 7.0)
        for row, (direction, by_controller) in zip(panels, found.items(), strict=True):
            row[0].set_ylabel(f"{direction} [mm]")
            for ax, spots in zip(row, by_controller.values(), strict=False):
                _draw(ax, spots, limits[direction])
                ax.set_ylim(0.0, 1.12e3 * highest)
            for ax in row[len(by_controller) :]:
                ax.set_visible(False)
        for ax in panels.ravel():
            ax.label_outer()
        handles: dict[str, Artist] = {}
        for ax in panels.ravel():
            handles.update({label: handle for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)})
        fig.legend(list(handles.values()), list(handles), loc="outside upper center", ncols=3)
        fig.supxlabel("duration of the swing, rest to rest [s]", fontsize=9)
        fig.supylabel("amplitude", fontsize=9)
        style.save(fig, folder, name)


def _draw(ax: Axes, spots: Sequence[Spot], limits: SwingLimits) -> None:
    ax.fill_between(
        limits.duration_s,
        1e3 * limits.capture_m,
        1e3,
        color=style.REFUSED,
        lw=0.0,
        label="reference's capture point outside the sole",
    )
    ax.plot(limits.duration_s, 1e3 * limits.capture_m, color=style.BLACK, lw=1.8)
    ax.plot(
        limits.duration_s,
        1e3 * limits.zmp_m,
        color=style.BLACK,
        ls=(0, (4, 2)),
        lw=1.2,
        label="reference's ZMP outside the sole, above",
    )
    for outcome, (label, look) in _MARKS.items():
        points = [(spot.place[0], 1e3 * level) for spot in spots for level, what in spot.levels if what == outcome]
        if points:
            x, y = np.array(points).T
            ax.scatter(x, y, label=label, zorder=3, linewidths=1.4, **look)
    for spot in spots:
        if not math.isnan(spot.threshold):
            duration, threshold = spot.place[0], 1e3 * spot.threshold
            ax.plot((duration - 0.03, duration + 0.03), (threshold, threshold), color=style.BLUE, lw=2.2, zorder=2)
            if spot.at_top:
                ax.text(duration + 0.035, threshold, "+", va="center", fontsize=9, color=style.BLUE)
    ax.set_xlim(limits.duration_s.min(), limits.duration_s.max())
