"""Time series as the dashboard shows them, drawn as one picture."""

import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from surefoot.experiments.plots import style

_PANEL_HEIGHT = 2.0  # inches


@dataclass(frozen=True, eq=False)
class Curve:
    """One line.

    Attributes:
        label: for the legend; empty for a limit.
        values: (n,), NaN where unknown.
        colour: red, green, blue, 0 to 255.
        width: of the line.
        dashed: or full.
    """

    label: str
    values: np.ndarray
    colour: tuple[int, int, int]
    width: float
    dashed: bool


@dataclass(frozen=True, eq=False)
class Panel:
    """One set of axes: title, lines, and lowest and highest value if they are given."""

    title: str
    curves: tuple[Curve, ...]
    span: tuple[float, float] | None


def draw_live(time_s: np.ndarray, panels: Sequence[Panel]) -> bytes:
    """Panels below each other over one time axis, as a PNG; an empty picture when there is nothing to draw."""
    with style.figure(0.5 + _PANEL_HEIGHT * max(len(panels), 1)) as drawn:
        for i, panel in enumerate(panels):
            ax = drawn.add_subplot(len(panels), 1, i + 1)
            for curve in panel.curves:
                ax.plot(
                    time_s,
                    curve.values,
                    color=tuple(part / 255.0 for part in curve.colour),
                    lw=0.8 * curve.width,
                    ls=(0, (4.0, 2.5)) if curve.dashed else "-",
                    label=curve.label or None,
                )
            ax.set_title(panel.title)
            if panel.span is not None:
                ax.set_ylim(*panel.span)
            if len(time_s) > 1:
                ax.set_xlim(float(time_s[0]), float(time_s[-1]))
            ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        if panels:
            drawn.axes[-1].set_xlabel(style.TIME)
        picture = io.BytesIO()
        drawn.savefig(picture, format="png", dpi=150, metadata={"Software": "surefoot"})
        return picture.getvalue()
