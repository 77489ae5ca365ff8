"""Figures 5, 6 and 7: ZMP and G over the left sole."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import LATCHED, SWING, SWING_HARDER
from surefoot.experiments.plots import style
from surefoot.experiments.runs.cases import CaseResult

_FROM_S, _TO_S = 0.8, 1.9
_ZMP_SHOWN_MM, _COM_SHOWN_MM = (-135.0, 135.0), (-120.0, 135.0)
_LAYERS = {"optimization (latched)": 6.0, "optimization": 3.6, "two-part": 1.4}  # line widths, where lines coincide


def _of(f: Findings, scenario: str) -> list[CaseResult]:
    return [
        f.run(scenario, "two-part"),
        f.run(scenario, "optimization"),
        f.run(scenario, "optimization", LATCHED),
    ]


def _points(result: CaseResult, what: str) -> np.ndarray:
    shown = result.column("time_s") >= _FROM_S
    return np.column_stack([result.column(f"{what}_{axis}_m")[shown] for axis in "xy"])


def _rightward(result: CaseResult, what: str, f: Findings) -> tuple[np.ndarray, np.ndarray]:
    return result.column("time_s"), -1e3 * (result.column(f"{what}_y_m") - f.place[1])


def _trace(ax: Axes, result: CaseResult, what: str, f: Findings, **kwargs: object) -> None:
    x, y = style.seen_from_above(_points(result, what), f.place)
    look = {**style.LINES[result.case.row], "label": style.NAMES[result.case.row], **kwargs}
    (line,) = ax.plot(x, y, **look)
    ax.plot(x[:1], y[:1], marker="o", ms=4, color=line.get_color(), ls="none")
    ax.plot(x[-1:], y[-1:], marker="X" if result.fell else "s", ms=6, color=line.get_color(), ls="none")


def _over_time(ax: Axes, f: Findings, scenario: str, what: str) -> None:
    """What lies to the right of P, against the sole's edges."""
    for edge in style.edges_at(f.sole, 0.02):
        ax.axhline(edge, color=style.GREY, lw=1.0)
    ax.axhspan(*style.edges_at(f.sole, 0.02), facecolor=style.SOLE, zorder=0)
    plan = f.predictions[scenario]
    if what == "zmp":
        wanted = -1e3 * (plan.zmp_in_world[:, 1] - f.place[1])
        ax.plot(plan.time_s, wanted, label="what the reference's own motion needs", **style.LINES["reference"])
    else:
        ax.plot(*_rightward(f.run(scenario, "two-part"), "com_ref", f), label="wanted", **style.LINES["reference"])
    for result in reversed(_of(f, scenario)):
        time, right = _rightward(result, what, f)
        ax.plot(time, right, label=style.NAMES[result.case.row], **style.LINES[result.case.row])
        if result.fell:
            ax.plot(time[-1], right[-1], marker="X", ms=7, color=style.LINES[result.case.row]["color"], ls="none")
    since = f.run(scenario, "optimization", LATCHED).summary["qp_infeasible_first_s"]
    style.mark_time(ax, since, f"{since or 0.0:.2f} s: QP infeasible")
    ax.set_xlim(_FROM_S, _TO_S)
    ax.set_ylim(*(_ZMP_SHOWN_MM if what == "zmp" else _COM_SHOWN_MM))
    ax.set_xlabel(style.TIME)
    ax.set_ylabel("to the right [mm]")


def _ending(result: CaseResult) -> str:
    return "falls" if result.fell else "stands"


def draw_figure_5(f: Findings, folder: Path) -> None:
    """ZMP over the left sole (a) with the technique, (b) under optimization, and both against time."""
    with style.figure(6.8) as fig:
        panels = fig.subplot_mosaic([["a", "b"], ["t", "t"]], height_ratios=(1.25, 1.0))
        two_part, unlatched, latched = _of(f, SWING)
        halves = f"(b) latched {_ending(latched)}, unlatched {_ending(unlatched)}"
        for name, title in (("a", f"(a) two-part {_ending(two_part)}"), ("b", halves)):
            ax = panels[name]
            style.draw_sole(ax, f.sole)
            x, y = style.seen_from_above(f.predictions[SWING].zmp_in_world, f.place)
            ax.plot(x, y, **style.LINES["reference"])
            ax.set_title(title)
            ax.set_xlim(-140, 140)
            ax.set_ylim(-130, 180)
        _trace(panels["a"], two_part, "zmp", f)
        _trace(panels["b"], latched, "zmp", f)
        _trace(panels["b"], unlatched, "zmp", f)
        _over_time(panels["t"], f, SWING, "zmp")
        panels["t"].set_title("(c) ZMP against time; the band is the sole")
        style.shared_legend(fig, panels["t"], 2)
        style.save(fig, folder, "figure_5")


def draw_figure_6(f: Findings, folder: Path) -> None:
    """G with and without the technique."""
    with style.figure(3.8) as fig:
        above, time = fig.subplots(1, 2, width_ratios=(1.0, 1.6))
        style.draw_sole(above, f.sole)
        for result in reversed(_of(f, SWING)):
            _trace(above, result, "com", f, lw=_LAYERS[result.case.row], ls="-")
        above.set_xlim(-110, 150)
        above.set_ylim(-130, 180)
        above.set_title("(a) seen from above")
        _over_time(time, f, SWING, "com")
        time.set_title("(b) against time; the band is the sole")
        style.shared_legend(fig, time, 2)
        style.save(fig, folder, "figure_6")


def draw_figure_7(f: Findings, folder: Path) -> None:
    """G and ZMP with the technique."""
    result = f.run(SWING, "two-part")
    with style.figure(3.8) as fig:
        above, time = fig.subplots(1, 2, width_ratios=(1.0, 1.6))
        style.draw_sole(above, f.sole)
        com = {"color": style.VERMILLION, "ls": (0, (5, 1.6)), "label": "G"}
        zmp = {"color": style.BLUE, "ls": "-", "label": "ZMP"}
        _trace(above, result, "zmp", f, **zmp)
        _trace(above, result, "com", f, **com)
        above.set_xlim(-110, 110)
        above.set_ylim(-130, 180)
        above.set_title("(a) seen from above")
        time.axhspan(*style.edges_at(f.sole, 0.02), facecolor=style.SOLE, zorder=0)
        for edge in style.edges_at(f.sole, 0.02):
            time.axhline(edge, color=style.GREY, lw=1.0)
        time.plot(*_rightward(result, "zmp", f), **zmp)
        time.plot(*_rightward(result, "com", f), **com)
        time.plot(*_rightward(result, "com_ref", f), label="G wanted", **style.LINES["reference"])
        time.set_xlim(_FROM_S, _TO_S)
        time.set_ylim(-95, 95)
        time.set_xlabel(style.TIME)
        time.set_ylabel("to the right [mm]")
        time.set_title("(b) against time; the band is the sole")
        style.shared_legend(fig, time, 3)
        style.save(fig, folder, "figure_7")


def draw_second_swing(f: Findings, folder: Path) -> None:
    """Figures 5 and 6 on the second calibrated swing."""
    with style.figure(5.2) as fig:
        zmp, com = fig.subplots(2, 1, sharex=True)
        _over_time(zmp, f, SWING_HARDER, "zmp")
        _over_time(com, f, SWING_HARDER, "com")
        zmp.set_title("(a) ZMP")
        com.set_title("(b) G")
        zmp.set_xlabel("")
        style.shared_legend(fig, zmp, 2)
        style.save(fig, folder, "second_swing")
