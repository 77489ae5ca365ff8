"""``surefoot run``: a scenario under a controller, its summary in words, as JSON or as a file."""

import json
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import tyro

from surefoot.cli.run_summary import print_summary
from surefoot.cli.stop_request import StopRequest, stop_request
from surefoot.errors import SurefootError

if TYPE_CHECKING:
    from surefoot.experiments.runs.recording import Recording
    from surefoot.experiments.runs.run import RunResult
    from surefoot.experiments.scenario.scenario import Scenario

_SUMMARY = ".json"
_OUT_KINDS = (_SUMMARY, ".csv", ".npz", ".parquet")


@dataclass(frozen=True)
class Run:
    """Run a scenario file headless, faster than real time, and print a summary.

    A simulated second of Bip takes 0.4 to 0.8 s of one core.
    """

    scenario: tyro.conf.Positional[str]
    """A TOML scenario file, or the name of a shipped scenario (stand_left, stone_outer_edge, ...)."""
    controller: str = "two-part"
    """optimization, soft-qp, two-part, two-part-literal, or one that an installed package brings."""
    robot: str | None = None
    """Another robot than the scenario's: its name, or the path of an MJCF, URDF or robot.toml (see robot check)."""
    sensors: str | None = None
    """How good the sensors are: perfect, lab, robot or cheap; short for --set sensors.preset=NAME."""
    estimator: str | None = None
    """Who makes a state of what they say: truth, or an estimator (surefoot settings); for --set estimator.kind=NAME."""
    motors: str | None = None
    """How good the motors are: perfect, lab, robot or cheap; short for --set motors.preset=NAME."""
    model_error: str | None = None
    """How far the robot is from its model: perfect, lab, robot or cheap; short for --set model_error.preset=NAME."""
    json: bool = False
    """Print one JSON object instead of a summary."""
    out: Path | None = None
    """Also write a file: .json the summary; .csv, .npz or .parquet every tick, kept in FILE.partial meanwhile."""
    set: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Change the scenario: dotted path = value, e.g. --set controller.guard=false --set stones.0.height_m=0.012."""

    def main(self) -> None:
        """Run it. Raises InvalidInput, PostureError, ControllerError."""
        from surefoot.experiments.runs.recording import Recording
        from surefoot.experiments.runs.saved_run import interruption
        from surefoot.experiments.scenario.changes import sizes_in_proportion
        from surefoot.experiments.scenario.scenario import load_scenario, parse_change
        from surefoot.output_files import check_kind, check_writable, write_file, writing

        if self.out is not None:
            check_kind(self.out, _OUT_KINDS)
            check_writable(self.out)
        changes = {**self._shortcuts(), **dict(parse_change(text) for text in self.set)}
        scenario = load_scenario(self.scenario, changes, robot_files=True)
        sizes = sizes_in_proportion(scenario, self.scenario, changes)
        if self.out is None or self.out.suffix == _SUMMARY:
            result = self._simulate(scenario, sizes)
            with self._told(result):
                if self.out is not None:
                    with writing(self.out):
                        write_file(self.out, json.dumps(result.summary, indent=1, allow_nan=False) + "\n")
            return
        with Recording(self.out, time.perf_counter_ns) as recording, _told_where_the_ticks_are(recording):
            with stop_request() as stop:
                result = self._simulate(scenario, sizes, recording, stop)
            with self._told(result):
                recording.write_out()
        if line := interruption(result.manifest):
            print(f"surefoot: {line} (in {self.out})", file=sys.stderr)
            raise SystemExit(stop.exit_code)

    def _shortcuts(self) -> dict[str, str]:
        """The flags that are short for a ``--set``, but for those that are not used; ``--set`` itself wins."""
        flags = {
            "robot": self.robot,
            "sensors.preset": self.sensors,
            "estimator.kind": self.estimator,
            "motors.preset": self.motors,
            "model_error.preset": self.model_error,
        }
        return {path: value for path, value in flags.items() if value is not None}

    def _simulate(
        self,
        scenario: "Scenario",
        in_proportion: Mapping[str, Any],
        recording: "Recording | None" = None,
        stop: StopRequest | None = None,
    ) -> "RunResult":
        from surefoot.cli.console import progress_bar
        from surefoot.experiments.runs.run import run

        with progress_bar() as bar:
            task = bar.add_task(f"{scenario.name} under {self.controller}", total=1.0)
            return run(
                scenario,
                self.controller,
                clock=time.perf_counter_ns,
                progress=lambda done: bar.update(task, completed=done),
                recording=recording,
                stop=stop,
                in_proportion=in_proportion,
            )

    @contextmanager
    def _told(self, result: "RunResult") -> Iterator[None]:
        """Write the file within, then print the summary: a full disk does not keep back what was computed."""
        try:
            yield
        finally:
            if self.json:
                print(json.dumps(result.summary, allow_nan=False))
                for warning in result.summary["warnings"]:
                    print(f"surefoot: warning: {warning}", file=sys.stderr)
            else:
                print_summary(result.summary, str(result.manifest["robot"]))


@contextmanager
def _told_where_the_ticks_are(recording: "Recording") -> Iterator[None]:
    """Say it of other runs, and of this one if it is ended by a second Ctrl-C or an error of ours."""
    for left in recording.earlier():
        print(f"surefoot: {left} is of another run, which was interrupted or goes on; it stays", file=sys.stderr)
    try:
        yield
    except SurefootError:
        raise
    except BaseException:
        if recording.partial is not None:
            print(f"surefoot: interrupted; what was recorded is in {recording.partial}", file=sys.stderr)
        raise
