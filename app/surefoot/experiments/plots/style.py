"""How every figure looks: width, type, colours that colour-blind eyes tell apart, axes of the paper."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from surefoot.geometry.polygon import ConvexPolygon

WIDTH = 7.2  # inches: the width of a page
_RC: dict[Any, Any] = {
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "svg.fonttype": "none",
    "svg.hashsalt": "surefoot",
    "figure.constrained_layout.use": True,
}

BLACK, GREY = "#000000", "#8a8a8a"
BLUE, ORANGE, VERMILLION, GREEN, PURPLE, SKY = "#0072b2", "#e69f00", "#d55e00", "#009e73", "#cc79a7", "#56b4e9"
STANDS, FALLS, REFUSED = "#cfe5f3", "#f6c9ad", "#ececec"
SOLE, STONE = "#f1eee6", "#7a6248"

# By the row's name: colour and dashes, so that lines differ in print too
LINES: dict[str, dict[str, Any]] = {
    "two-part": {"color": BLUE, "ls": "-", "lw": 1.9},
    "optimization": {"color": VERMILLION, "ls": (0, (5, 1.6))},
    "optimization (latched)": {"color": ORANGE, "ls": (0, (5, 1.3, 1.2, 1.3)), "lw": 1.8},
    "two-part-literal": {"color": PURPLE, "ls": (0, (2.4, 1.2))},
    "soft-qp": {"color": GREEN, "ls": (0, (1.2, 1.0))},
    "reference": {"color": BLACK, "ls": (0, (1.0, 1.4)), "lw": 1.3},
}
NAMES = {
    "two-part": "two-part (the technique)",
    "optimization": "optimization, tries again each tick",
    "optimization (latched)": "optimization, latched",
    "two-part-literal": "two-part-literal ((28) as printed)",
    "soft-qp": "soft-qp",
}

RIGHTWARD = "to the right: the paper's z (our −y) [mm]"
FORWARD = "forward: x [mm]"
TIME = "time [s]"


@contextmanager
def figure(height: float) -> Iterator[Figure]:
    """An empty figure of the page's width, in our style."""
    with mpl.rc_context(_RC):
        yield Figure(figsize=(WIDTH, height))


def save(drawn: Figure, folder: Path, name: str) -> None:
    """Write NAME.png and NAME.svg. To be called inside ``figure``."""
    drawn.savefig(folder / f"{name}.png", dpi=180, metadata={"Software": "surefoot"})
    drawn.savefig(folder / f"{name}.svg", metadata={"Date": None, "Creator": "surefoot"})


def shared_legend(drawn: Figure, ax: Axes, columns: int) -> None:
    """One legend for the whole figure, above the panels, so that it covers no curve."""
    handles, labels = ax.get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=columns, columnspacing=1.6, handlelength=2.6)


def mark_time(ax: Axes, time_s: float | None, text: str) -> None:
    """A thin line at an instant, named at the panel's upper end; nothing for an instant that never came."""
    if time_s is None:
        return
    ax.axvline(time_s, color=BLACK, lw=0.8, alpha=0.7)
    ax.text(
        time_s,
        0.93,
        f" {text}",
        transform=ax.get_xaxis_transform(),
        fontsize=8,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0},
    )


def seen_from_above(points: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """World points (n, 2) [m] as the paper has them: to the right and forward of P, in mm."""
    away = 1e3 * (points - place)
    return -away[:, 1], away[:, 0]


def draw_sole(ax: Axes, sole: ConvexPolygon, *, label: str | None = None) -> None:
    """The outline of a sole about P, seen from above; walking direction up."""
    x, y = seen_from_above(sole.vertices, np.zeros(2))
    ax.fill(x, y, facecolor=SOLE, edgecolor=GREY, lw=1.0, zorder=0, label=label)
    ax.plot(0.0, 0.0, marker="+", color=GREY, ms=7, zorder=1)
    ax.set_aspect("equal")
    ax.set_xlabel(RIGHTWARD)
    ax.set_ylabel(FORWARD)


def edges_at(sole: ConvexPolygon, forward_m: float) -> tuple[float, float]:
    """Left and right edge of the sole [mm, to the right of P] at a distance ahead of P."""
    right = 1e3 * sole.distance_to_edge(np.array((forward_m, 0.0)), np.array((0.0, -1.0)))
    left = 1e3 * sole.distance_to_edge(np.array((forward_m, 0.0)), np.array((0.0, 1.0)))
    return -left, right
