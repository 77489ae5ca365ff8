"""What the commands share: bars of progress, a console for wide tables, lines of warning, a check of ``--workers``."""

import sys
from collections.abc import Mapping
from typing import Any

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from surefoot.errors import InvalidInput

_WIDTH = 150
_ESTIMATE_S = 600.0  # cells take from a second to minutes: the time left is estimated from this much of the past


def progress_bar() -> Progress:
    """A bar on standard error that vanishes once done; none where that is no terminal."""
    return Progress(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty())


def cells_bar(*, stays: bool = False) -> Progress:
    """The bar for the cells of a bench, with the time left.

    Args:
        stays: keep it once done, and show the time that went by.
    """
    columns: list[ProgressColumn] = [
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("cells"),
    ]
    if stays:
        columns.append(TimeElapsedColumn())
    columns += [TextColumn("left"), TimeRemainingColumn()]
    return Progress(
        *columns,
        console=Console(stderr=True),
        transient=not stays,
        disable=not sys.stderr.isatty(),
        speed_estimate_period=_ESTIMATE_S,
    )


def wide_console() -> Console:
    """As wide as the terminal; wide enough for the tables where there is none."""
    return Console(width=None if sys.stdout.isatty() else _WIDTH)


def tell_unavailable_controllers() -> None:
    """A line on standard error for every installed controller that cannot be used: for what takes all there are."""
    from surefoot.control.registry import unavailable_controllers

    for name, reason in unavailable_controllers().items():
        print(f"surefoot: controller {name} is not available: {reason}", file=sys.stderr)


def tell_notes(manifest: Mapping[str, Any]) -> None:
    """Lines on standard error where a saved run was interrupted, and where its robot's files have changed."""
    from surefoot.experiments.runs.robot_files import robot_note
    from surefoot.experiments.runs.saved_run import interruption

    for line in (interruption(manifest), robot_note(manifest)):
        if line:
            print(f"surefoot: {line}", file=sys.stderr)


def check_workers(workers: int) -> None:
    """Raises InvalidInput for less than one process."""
    if workers < 1:
        raise InvalidInput("--workers", workers, "must be at least 1")
