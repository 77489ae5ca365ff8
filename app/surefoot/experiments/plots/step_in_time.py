"""A step onto one stone against time: the ankle's roll and its stop, ZMP and centre of mass beside the foot."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import STEPPERS, TOLD
from surefoot.experiments.paper.steps import ROLL, alone_on_stone, ending
from surefoot.experiments.plots import style
from surefoot.experiments.runs.cases import CaseResult
from surefoot.experiments.scenario.references import planned_footsteps
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.experiments.scenario.step_onto_stone import SCENE
from surefoot.robot.description import load_robot

_FROM_S, _TO_S = 1.2, 3.8
_LOADED_N = 50.0  # a foot that carries less has no ZMP of its own
_SHOWN_MM = (-260.0, 100.0)
_SHOWN_RAD = (-0.12, 0.25)


def draw_step_in_time(f: Findings, folder: Path) -> None:
    """One column a controller; the shading is the time on the stone alone, the other foot in the air."""
    landed = planned_footsteps(load_scenario(SCENE))[0].point
    with style.figure(6.2) as fig:
        panels = fig.subplots(3, len(STEPPERS), sharex=True, sharey="row")
        for column, contender in zip(panels.T, STEPPERS, strict=True):
            result = f.step(*TOLD, contender)
            _roll(column[0], result)
            _zmp(column[1], f, result, landed)
            _com(column[2], f, result, landed)
            for ax in column:
                _alone(ax, result)
                if result.fell:
                    ax.axvline(result.summary["fall_time_s"], color=style.VERMILLION, lw=1.2, ls=(0, (4, 1.6)))
            column[0].set_title(f"{result.case.controller}\n{_ending(result)}", fontsize=8.5)
            column[2].set_xlabel(style.TIME)
        for ax, label in zip(
            panels[:, 0], ("roll of the left ankle [rad]", "ZMP, outward [mm]", "G, outward [mm]"), strict=True
        ):
            ax.set_ylabel(label)
        panels[0, 0].set_xlim(_FROM_S, _TO_S)
        style.save(fig, folder, "step_in_time")


def _ending(result: CaseResult) -> str:
    end = ending(result).replace("_", " ")
    return f"{end}\nfalls at {result.summary['fall_time_s']:.2f} s" if result.fell else f"{end}\n "


def _roll(ax: Axes, result: CaseResult) -> None:
    ax.axhline(load_robot("bip").joint_named(ROLL).upper_rad, color=style.GREY, lw=1.0)
    ax.plot(result.column("time_s"), result.column(f"angle_{ROLL}_rad"), color=style.BLUE)
    ax.set_ylim(*_SHOWN_RAD)


def _zmp(ax: Axes, f: Findings, result: CaseResult, landed: np.ndarray) -> None:
    _sole(ax, f)
    loaded = result.column("force_left_n") > _LOADED_N
    ax.plot(*_outward(result, "zmp", landed, loaded), color=style.BLUE)


def _com(ax: Axes, f: Findings, result: CaseResult, landed: np.ndarray) -> None:
    _sole(ax, f)
    always = np.ones(len(result.column("time_s")), dtype=bool)
    ax.plot(*_outward(result, "com_ref", landed, always), **style.LINES["reference"])
    ax.plot(*_outward(result, "com", landed, always), color=style.BLUE)


def _outward(result: CaseResult, what: str, landed: np.ndarray, shown: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Time [s] and distance to the left of the landed foot's P [mm]; a gap where it is not to be shown."""
    outward = 1e3 * (result.column(f"{what}_y_m") - landed[1])
    return result.column("time_s"), np.where(shown, outward, np.nan)


def _sole(ax: Axes, f: Findings) -> None:
    right, left = (-edge for edge in style.edges_at(f.sole, 0.02)[::-1])
    ax.axhspan(right, left, facecolor=style.SOLE, zorder=0)
    ax.set_ylim(*_SHOWN_MM)


def _alone(ax: Axes, result: CaseResult) -> None:
    """Shade the time in which the foot that has landed on the stone carries the robot alone."""
    across = ax.get_xaxis_transform()
    look = {"color": style.STANDS, "alpha": 0.5, "lw": 0.0, "zorder": 0.5}
    ax.fill_between(result.column("time_s"), 0.0, 1.0, where=alone_on_stone(result), transform=across, **look)
