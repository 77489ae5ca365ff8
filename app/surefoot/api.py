"""Runs from Python: the same ticks, to the bit, as ``surefoot run``, the page and the workers of the bench.

    import surefoot

    result = surefoot.run("stone_outer_edge", "optimization", changes={"stones.0.height_m": 0.012})
    print(result.fell, result.fall_time_s, result.column("zmp_margin_m").min())
    result.save("fall.html")

The names for users stand in ``surefoot.__all__``; they are imported from ``surefoot`` itself.
"""

import base64
import contextlib
import html
import warnings
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.blas_threads import one_blas_thread
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.robot_files import robot_note, with_robot
from surefoot.experiments.runs.run import run as simulate
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.runs.saved_run import INTERRUPTED, KINDS, SavedRun, arrow, interruption
from surefoot.experiments.scenario.changes import sizes_in_proportion
from surefoot.experiments.scenario.scenario import Scenario, load_scenario
from surefoot.output_files import check_writable, write_file, writing

_PAGE = ".html"


class Run:
    """A run as data; in a notebook it shows its summary, a small plot and a replay.

    Attributes:
        columns: names of the table's columns, with their units.
        table: every tick (n, columns), oldest first; of a long run that was not recorded into a file by ``surefoot
            run --out``, the last two minutes.
        manifest: what made it: scenario, controller, settings, stones, events, commit, versions.
        summary: the JSON object of ``surefoot run --json``; empty for a run that the page saved.
    """

    def __init__(self, saved: SavedRun) -> None:
        self._saved = saved
        self.columns, self.table, self.manifest = saved.columns, saved.table, saved.manifest
        self.summary: Mapping[str, Any] = saved.manifest.get("summary", {})

    @property
    def fell(self) -> bool:
        """Whether the robot fell."""
        known = any(kind == "fall" for _, kind, _ in self.manifest.get("events", ()))
        return bool(self.summary.get("fell", known))

    @property
    def fall_time_s(self) -> float | None:
        """When; None where it did not, or where the page saved the run."""
        return self.summary.get("fall_time_s")

    @property
    def fall_cause(self) -> str | None:
        """Why; None where it did not, or where the page saved the run."""
        return self.summary.get("fall_cause")

    @property
    def first_limit(self) -> str | None:
        """The limit that went first; None for none, or where the page saved the run."""
        return self.summary.get("first_limit")

    @property
    def interrupted_s(self) -> float | None:
        """Where the record ends, if the run was stopped or killed before its end; None for all others."""
        return self.manifest.get(INTERRUPTED)

    def column(self, name: str) -> np.ndarray:
        """One column (n,). Raises InvalidInput listing the columns."""
        return self._saved.column(name)

    def arrow(self) -> Any:
        """The table as a ``pyarrow.Table``, the manifest in its metadata."""
        return arrow(self._saved)

    def save(self, path: str | Path) -> None:
        """Write the run (.npz, .parquet) or a page that replays it from disk (.html). Raises InvalidInput."""
        file = Path(path)
        if file.suffix not in (*KINDS, _PAGE):
            raise InvalidInput("path", str(file), "unknown kind of file", (*KINDS, _PAGE))
        check_writable(file, "path")
        with writing(file, "path"):
            if file.suffix == _PAGE:
                write_file(file, self.replay_page())
            else:
                write_run(self._saved, file)

    def replay_page(self) -> str:
        """The run as one HTML page."""
        from surefoot.dashboard.replay.html_export import replay_html

        return replay_html(self._saved)

    def plot(self) -> bytes:
        """ZMP margin and lateral CoM over time, as a PNG."""
        from surefoot.dashboard.ui import palette
        from surefoot.experiments.plots.live import Curve, Panel, draw_live

        plotted = (
            ("ZMP margin [mm]", "zmp_margin_m", palette.ZMP_MEASURED),
            ("CoM, lateral [mm]", "com_y_m", palette.COM),
        )
        panels = [
            Panel(title, (Curve(title, 1e3 * self.column(name), colour, 1.5, False),), None)
            for title, name, colour in plotted
        ]
        return draw_live(self.column("time_s"), panels)

    def __repr__(self) -> str:
        """Scenario, controller, outcome."""
        end = f"fell at {self.fall_time_s} s by {self.fall_cause}" if self.fell else "stands"
        if self.interrupted_s is not None:
            end = f"interrupted at t = {self.interrupted_s:.3f} s"
        name, controller = self.manifest.get("scenario_name"), self.manifest.get("controller")
        return f"<surefoot.Run {name}, {controller}: {end}, {len(self.table)} ticks>"

    def _repr_html_(self) -> str:
        shown = {key: value for key, value in self.summary.items() if not isinstance(value, dict | list)}
        rows = "".join(f"<tr><th>{html.escape(key)}</th><td>{html.escape(str(shown[key]))}</td></tr>" for key in shown)
        picture = base64.b64encode(self.plot()).decode()
        return (
            f"<p>{html.escape(repr(self))}</p><details><summary>summary</summary><table>{rows}</table></details>"
            f'<img alt="ZMP margin and lateral CoM" src="data:image/png;base64,{picture}">'
            f'<iframe title="replay" width="100%" height="420" srcdoc="{html.escape(self.replay_page())}"></iframe>'
        )


def run(
    scenario: str | Path | Scenario,
    controller: str = "two-part",
    *,
    robot: str | Path | None = None,
    changes: Mapping[str, Any] | None = None,
    progress: bool = False,
) -> Run:
    """Simulate a scenario to its end or to the fall.

    Args:
        scenario: name of a shipped one, a TOML file, or one already loaded.
        controller: name, see ``controllers()``.
        robot: another one than the scenario's: its name, or the path of an MJCF or robot.toml from the working folder.
        changes: dotted path -> value, as ``--set`` has them, e.g. ``{"controller.guard": False}``.
        progress: show a bar.

    Raises:
        InvalidInput: one of them cannot be used; the text lists what can.
        PostureError: the scenario asks for a posture that the robot cannot take.
    """
    if isinstance(scenario, Scenario):
        for name, value in (("changes", dict(changes or {})), ("robot", robot)):
            if value:
                raise InvalidInput(name, value, "are for a scenario by name or file", ["load_scenario(name)"])
        loaded, sizes = scenario, {}
    else:
        asked = {**(changes or {}), **({} if robot is None else {"robot": str(robot)})}
        loaded = load_scenario(str(scenario), asked, robot_files=True)
        sizes = sizes_in_proportion(loaded, str(scenario), asked)
    with _bar(f"{loaded.name} under {controller}") if progress else contextlib.nullcontext() as update:
        with one_blas_thread():
            result = simulate(loaded, controller, progress=update, in_proportion=sizes)
    return Run(SavedRun(tuple(result.recorder.columns), result.recorder.table(), result.manifest))


def open_run(path: str | Path, *, robot: str | Path | None = None) -> Run:
    """A run from a file of ``surefoot run --out``, ``Run.save`` or the page (.npz, .parquet). Raises InvalidInput.

    The .partial that an interrupted one left opens too. That a run was interrupted is a warning, see ``interrupted_s``,
    and so is that its robot's files have changed since.

    Args:
        path: of the file.
        robot: where its robot's file lies now, if not where it lay.
    """
    opened = with_robot(read_run(Path(path)), None if robot is None else str(robot))
    for line in (interruption(opened.manifest), robot_note(opened.manifest)):
        if line:
            warnings.warn(f"{path}: {line}", stacklevel=2)
    return Run(opened)


@contextlib.contextmanager
def _bar(what: str) -> Iterator[Callable[[float], None]]:
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=1.0)
        yield lambda done: bar.update(task, completed=done)
