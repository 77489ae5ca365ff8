"""Tables of outcomes as pictures: who stands, who falls, and by how much."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.patches import Patch, Rectangle

from surefoot.experiments.plots import style
from surefoot.experiments.studies.outcomes import Outcome, OutcomeTable

_FILL = {"stands": style.STANDS, "falls": style.FALLS, "refused": style.REFUSED}
_HATCH = {"falls": "////", "refused": "...."}
_MEANING = {
    "stands": "stands: largest CoM error [mm] (* with ticks infeasible)",
    "falls": "falls: when [s]",
    "refused": "refused",
}


def draw_tables(tables: Sequence[OutcomeTable], folder: Path, name: str, *, slanted: bool = False) -> None:
    """One panel a table, in one figure; many columns need ``slanted`` headings and have room for whole mm only."""
    rows = sum(len(table.rows) for table in tables)
    with style.figure(0.27 * rows + 0.75 * len(tables) + (0.9 if slanted else 0.3)) as fig:
        heights = [len(table.rows) for table in tables]
        panels = fig.subplots(len(tables), 1, squeeze=False, height_ratios=heights)[:, 0]
        for ax, table in zip(panels, tables, strict=True):
            _draw(ax, table, slanted=slanted)
        kinds = {cell.kind for table in tables for cell in table.cells.values()}
        handles = [
            Patch(facecolor=_FILL[kind], edgecolor="#b8855f", hatch=_HATCH.get(kind), lw=0.0, label=_MEANING[kind])
            for kind in _FILL
            if kind in kinds
        ]
        fig.legend(handles=handles, loc="outside lower center", ncols=3)
        style.save(fig, folder, name)


def _draw(ax: Axes, table: OutcomeTable, *, slanted: bool) -> None:
    for r, row in enumerate(table.rows):
        for c, column in enumerate(table.columns):
            cell = table.cells[row, column]
            ax.add_patch(Rectangle((c, r), 1.0, 1.0, facecolor=_FILL[cell.kind], edgecolor="white", lw=1.5))
            if cell.kind in _HATCH:
                ax.add_patch(
                    Rectangle((c, r), 0.13, 1.0, facecolor="none", edgecolor="#b8855f", hatch=_HATCH[cell.kind], lw=0.0)
                )
            ax.text(c + 0.54, r + 0.5, _text(cell, brief=slanted), ha="center", va="center", fontsize=7.2)
    ax.set_xlim(0, len(table.columns))
    ax.set_ylim(len(table.rows), 0)
    ax.grid(False)
    ax.tick_params(length=0)
    for spine in ax.spines.values():
        spine.set_visible(False)
    ax.set_yticks([r + 0.5 for r in range(len(table.rows))], table.rows, fontsize=8)
    ax.xaxis.set_ticks_position("top")
    places = [c + 0.5 for c in range(len(table.columns))]
    if slanted:
        ax.set_xticks(places, table.columns, fontsize=7.5, rotation=38, ha="left", rotation_mode="anchor")
    else:
        ax.set_xticks(places, [column.replace(": ", "\n") for column in table.columns], fontsize=8)
        ax.set_title(table.title, pad=10)


def _text(cell: Outcome, *, brief: bool) -> str:
    if cell.number is None:
        return "–" if brief else cell.kind
    digits = {"stands": 0 if brief else 1, "falls": 2}[cell.kind]
    return f"{cell.number:.{digits}f}{cell.note}"
