"""Pushes in all directions against the capture bound, one polar panel a controller and support."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.projections.polar import PolarAxes

from surefoot.experiments.maps.data import Spot
from surefoot.experiments.plots import style

_AROUND = np.arange(0.0, 361.0, 1.0)
_WIDTH = np.deg2rad(5.0)  # slim: a bar speaks of its own direction only


def draw_push_map(
    found: Mapping[str, Mapping[str, Sequence[Spot]]], bounds: Mapping[str, np.ndarray], folder: Path, name: str
) -> None:
    """One panel a support and controller, two side by side.

    Args:
        found: support's title -> controller -> spots.
        bounds: support's title -> J_cap over ``directions()`` [N s].
        folder: where to write.
        name: of the files.
    """
    drawn = [(title, controller, spots) for title, by in found.items() for controller, spots in by.items()]
    columns = min(max(len(by_controller) for by_controller in found.values()), 2)
    rows = -(-len(drawn) // columns)
    with style.figure(3.6 * rows + 0.6) as fig:
        panels = fig.subplots(rows, columns, squeeze=False, subplot_kw={"projection": "polar"}).ravel()
        for ax, (title, controller, spots) in zip(panels, drawn, strict=False):
            _draw(ax, spots, bounds[title], 1.12 * float(bounds[title].max()))
            ax.set_title(f"{controller}, {title}" if len(found) > 1 else controller, pad=12)
        for ax in panels[len(drawn) :]:
            ax.set_visible(False)
        handles, labels = panels[0].get_legend_handles_labels()
        fig.legend(handles, labels, loc="outside lower center", ncols=3)
        style.save(fig, folder, name)


def directions() -> np.ndarray:
    """Directions (n,) [deg] at which the bound is wanted."""
    return _AROUND


def _draw(ax: PolarAxes, spots: Sequence[Spot], bound: np.ndarray, top: float) -> None:
    ax.set_theta_zero_location("N")
    for i, spot in enumerate(spots):
        angle, limit = np.deg2rad(spot.place[0]), spot.place[1]
        size = 0.0 if math.isnan(spot.threshold) else spot.threshold
        label = "largest impulse survived (number: share of the bound)" if i == 0 else None
        ax.bar(angle, size * limit, width=_WIDTH, color=style.SKY, edgecolor=style.BLUE, lw=0.8, label=label)
        text = f"{size:.2f}{'+' if spot.at_top else ''}" if spot.lowest is None else f"< {spot.lowest:.2f}"
        ax.text(
            angle,
            max(0.62 * size * limit, 0.24 * top),
            text,
            ha="center",
            va="center",
            fontsize=7.5,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.6},
        )
    ax.plot(np.deg2rad(_AROUND), bound, color=style.VERMILLION, lw=2.0, label="capture bound J_cap(T)")
    ax.set_ylim(0.0, top)
    ax.set_xticks(np.deg2rad((0, 90, 180, 270)), ["forward", "left", "backward", "right"])
    ax.tick_params(axis="x", pad=0, labelsize=8)
    rings = [ring for ring in (20, 40, 60, 80, 100) if ring < top]
    ax.set_yticks(rings, [f"{ring}" if ring != rings[-1] else f"{ring} N s" for ring in rings], fontsize=7)
    ax.set_rlabel_position(292.0)
