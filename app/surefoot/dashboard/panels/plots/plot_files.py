"""What the plots show, as files: every row as CSV, or drawn as PNG."""

import csv
import io
from collections.abc import Sequence

import numpy as np
import viser

from surefoot.dashboard.messages.signals import TRACE_COLUMNS
from surefoot.dashboard.messages.snapshot import PlotLimits
from surefoot.dashboard.ui.plot_kinds import PlotKind


def send_csv(client: viser.ClientHandle, kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> None:
    """Give a browser the columns of some plots."""
    client.send_file_download("surefoot-plots.csv", traces_csv(kinds, limits, rows), save_immediately=True)


def send_png(client: viser.ClientHandle, kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> None:
    """Give a browser a picture of some plots."""
    client.send_file_download("surefoot-plots.png", traces_png(kinds, limits, rows), save_immediately=True)


def traces_csv(kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> bytes:
    """Time and every column that one of the plots shows, all rows, with a line of names."""
    used = {trace.source for kind in kinds for trace in kind.traces(limits)}
    columns = [i for i, name in enumerate(TRACE_COLUMNS) if i == 0 or name in used]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([TRACE_COLUMNS[i] for i in columns])
    writer.writerows([[f"{value:.6g}" for value in row] for row in rows[:, columns]])
    return text.getvalue().encode()


def traces_png(kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> bytes:
    """The plots below each other, drawn for print."""
    from surefoot.experiments.plots.live import Curve, Panel, draw_live  # Matplotlib takes a while to load

    panels = [
        Panel(
            title=kind.title, span=kind.span(limits),
            curves=tuple(
                Curve(trace.label, trace.values(rows), trace.colour, trace.width, bool(trace.dash))
                for trace in kind.traces(limits)
            ),
        )
        for kind in kinds
    ]  # fmt: skip
    return draw_live(rows[:, 0], panels)
