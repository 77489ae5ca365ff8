"""Figure 1: the static case, a stone under the outer edge of the stance foot, drawn from the simulated poses."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.poses import Pose
from surefoot.experiments.plots import style

_BEFORE: dict[str, Any] = {"color": style.GREY, "lw": 1.3}
_AFTER: dict[str, Any] = {"color": style.BLUE, "lw": 2.0}
_ZMP: dict[str, Any] = {"marker": "x", "ms": 8, "mew": 2.2, "ls": "none"}
_COM: dict[str, Any] = {"marker": "o", "ms": 7, "mfc": "white", "mew": 1.8, "ls": "none"}


def draw_figure_1(f: Findings, folder: Path) -> None:
    """(a) without the technique balance is lost, (b) with it balance is kept; each at two instants."""
    with style.figure(7.4) as fig:
        panels = fig.subplots(2, 3, width_ratios=(0.95, 1.15, 1.0))
        for letter, row, track in zip("ab", panels, f.static_case, strict=True):
            before, after = track.poses[0], track.poses[-1]
            whole, close, above = row
            for pose, look in ((before, _BEFORE), (after, _AFTER)):
                _robot(whole, pose, look, f.place)
                _foot(close, pose, look, f.place)
                _from_above(above, pose, look, f.place)
            for ax in (whole, close):
                _stones_from_behind(ax, after, f.place)
            _stones_from_above(above, after, f.place)
            end = f"falls at {track.fall_time_s:.2f} s" if track.fall_time_s else f"stands ({after.time_s:.2f} s)"
            whole.set_title(f"({letter}) {track.case.row}: {end}")
        for ax, label in zip(panels[1], ("seen from behind", "the foot from behind", "from above"), strict=True):
            ax.set_xlabel(f"z, to the right [mm]\n{label}")
        fig.legend(handles=_legend(), loc="outside upper center", ncols=5, columnspacing=1.4)
        style.save(fig, folder, "figure_1")


def _legend() -> list[Any]:
    return [
        Line2D([], [], label="before the stone rises", **_BEFORE),
        Line2D([], [], label="at the end", **_AFTER),
        Patch(color=style.STONE, alpha=0.7, label="stone"),
        Line2D([], [], color=style.BLUE, label="G", **_COM),
        Line2D([], [], color=style.VERMILLION, label="ZMP", **_ZMP),
    ]


def _right(points: np.ndarray, place: np.ndarray) -> np.ndarray:
    return -1e3 * (points[..., 1] - place[1])


def _sole_from_behind(ax: Axes, sole: np.ndarray, look: dict[str, Any], place: np.ndarray, width: float) -> None:
    x, z = _right(sole, place), 1e3 * sole[:, 2]
    left, right = x.argmin(), x.argmax()
    ax.plot((x[left], x[right]), (z[left], z[right]), color=look["color"], lw=width, solid_capstyle="butt")


def _robot(ax: Axes, pose: Pose, look: dict[str, Any], place: np.ndarray) -> None:
    for chain in pose.chains:
        ax.plot(_right(chain, place), 1e3 * chain[:, 2], marker="o", ms=2.6, **look)
    for sole in pose.soles:
        _sole_from_behind(ax, sole, look, place, 3.0)
    x, z = float(_right(pose.com, place)), 1e3 * float(pose.com[2])
    ax.plot((x, x), (0.0, z), color=look["color"], lw=0.9, ls=(0, (4, 2)))
    ax.plot(x, z, color=look["color"], **_COM)
    ax.axhline(0.0, color=style.BLACK, lw=1.0)
    ax.set_aspect("equal")
    ax.set_xlim(-280, 380)
    ax.set_ylim(-40, 1450)
    ax.set_ylabel("height [mm]")


def _foot(ax: Axes, pose: Pose, look: dict[str, Any], place: np.ndarray) -> None:
    _sole_from_behind(ax, pose.soles[0], look, place, 2.4)
    ankle = (float(_right(pose.ankle, place)), 1e3 * float(pose.ankle[2]))
    middle = pose.soles[0].mean(axis=0)
    ax.plot((float(_right(middle, place)), ankle[0]), (1e3 * middle[2], ankle[1]), **look)
    ax.plot(*ankle, marker="o", ms=5, color=look["color"])
    x = float(_right(pose.com, place))
    ax.plot((x, x), (0.0, 110.0), color=look["color"], lw=0.9, ls=(0, (4, 2)))
    colour = style.VERMILLION if look is _AFTER else style.GREY
    ax.plot(-1e3 * (pose.zmp[1] - place[1]), 0.0, color=colour, zorder=5, clip_on=False, **_ZMP)
    ax.axhline(0.0, color=style.BLACK, lw=1.0)
    ax.set_aspect(2.0)
    ax.set_xlim(-115, 115)
    ax.set_ylim(-12, 115)


def _stones_from_behind(ax: Axes, pose: Pose, place: np.ndarray) -> None:
    for stone in pose.stones:
        top, width = 1e3 * stone.top_at(pose.time_s), 1e3 * stone.size_m[1]
        left = -1e3 * (stone.y_m - place[1]) - 0.5 * width
        ax.add_patch(Rectangle((left, 0.0), width, max(top, 0.0), color=style.STONE, alpha=0.7, lw=0, zorder=1))


def _stones_from_above(ax: Axes, pose: Pose, place: np.ndarray) -> None:
    for stone in pose.stones:
        length, width = (1e3 * size for size in stone.size_m)
        x, y = style.seen_from_above(np.array([(stone.x_m, stone.y_m)]), place)
        corner = (float(x[0]) - 0.5 * width, float(y[0]) - 0.5 * length)
        ax.add_patch(Rectangle(corner, width, length, color=style.STONE, alpha=0.7, lw=0, zorder=1))


def _from_above(ax: Axes, pose: Pose, look: dict[str, Any], place: np.ndarray) -> None:
    corners = pose.soles[0][np.r_[0:4, 0], :2]
    ax.plot(*style.seen_from_above(corners, place), **look)
    colour = style.VERMILLION if look is _AFTER else style.GREY
    ax.plot(*style.seen_from_above(pose.com[None, :2], place), color=look["color"], **_COM)
    ax.plot(*style.seen_from_above(pose.zmp[None], place), color=colour, **_ZMP)
    ax.set_aspect("equal")
    ax.set_xlim(-125, 125)
    ax.set_ylim(-140, 250)
    ax.set_ylabel(style.FORWARD)
