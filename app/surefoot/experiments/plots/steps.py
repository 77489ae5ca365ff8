"""Steps onto stones: place by height, one panel a controller; who completes the walk, and what began each fall."""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.patches import Patch, Rectangle

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import STEPPERS
from surefoot.experiments.paper.steps import COMPLETED, UNFINISHED, Contender, completed, ending, stones
from surefoot.experiments.plots import style
from surefoot.experiments.runs.cases import Case

_HATCH_EDGE = "#b8855f"


def draw_steps(f: Findings, folder: Path) -> None:
    """One panel a controller."""
    with style.figure(0.72 * len(f.plan.places) + 1.9) as fig:
        panels = fig.subplots(2, 2, sharex=True, sharey=True).ravel()
        for ax, contender in zip(panels, STEPPERS, strict=True):
            _draw(ax, f, contender)
            name, changes = contender
            held = len(completed(f, contender, f.plan.places))
            ax.set_title(f"{Case('', name, changes).row}: {held} of {stones(f)}")
        for ax in panels[2:]:
            ax.set_xlabel("height of the stone [mm]")
        for ax in panels[::2]:
            ax.set_ylabel("stone below the")
        fig.legend(
            handles=[
                Patch(facecolor=style.STANDS, label="walk completed"),
                Patch(facecolor=style.FALLS, edgecolor=_HATCH_EDGE, hatch="////", lw=0.0, label="fell: what began it"),
            ],
            loc="outside lower center",
            ncols=2,
        )
        style.save(fig, folder, "step_onto_stone")


def _draw(ax: Axes, f: Findings, contender: Contender) -> None:
    for row, place in enumerate(f.plan.places):
        for column, height_m in enumerate(f.plan.heights_m):
            end = ending(f.step(place, height_m, contender))
            fell = end not in (COMPLETED, UNFINISHED)
            fill = style.FALLS if fell else style.STANDS if end == COMPLETED else style.REFUSED
            ax.add_patch(Rectangle((column, row), 1.0, 1.0, facecolor=fill, edgecolor="white", lw=1.5))
            if fell:
                ax.add_patch(
                    Rectangle((column, row), 0.1, 1.0, facecolor="none", edgecolor=_HATCH_EDGE, hatch="////", lw=0.0)
                )
            word, size = ("✓", 10.0) if end == COMPLETED else (end.replace("_", "\n"), 7.0)
            ax.text(column + 0.53, row + 0.5, word, ha="center", va="center", fontsize=size, linespacing=0.95)
    ax.set_xlim(0, len(f.plan.heights_m))
    ax.set_ylim(len(f.plan.places), 0)
    ax.grid(False)
    ax.tick_params(length=0)
    for spine in ax.spines.values():
        spine.set_visible(False)
    ax.set_xticks([i + 0.5 for i in range(len(f.plan.heights_m))], [f"{1e3 * h:g}" for h in f.plan.heights_m])
    ax.set_yticks([i + 0.5 for i in range(len(f.plan.places))], f.plan.places)
