"""The command line: every flag has a help text; a mistake is one clear line and exit code 2."""

import os

# One BLAS thread: the matrices are 21 x 21, threads would only fight over the cores. Before NumPy is imported.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from surefoot.errors import SurefootError


@dataclass(frozen=True)
class Run:
    """Run a scenario file headless, faster than real time, and print a summary."""

    scenario: tyro.conf.Positional[str]
    """A TOML scenario file, or the name of a shipped scenario (stand_left, stone_outer_edge, ...)."""
    controller: str = "two-part"
    """optimization, soft-qp, two-part, two-part-literal, or one that an installed package brings."""
    json: bool = False
    """Print one JSON object instead of a summary."""
    out: Path | None = None
    """Also write a file: .json the summary; .csv, .npz or .parquet every tick."""
    set: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Change the scenario: dotted path = value, e.g. --set controller.guard=false --set stones.0.height_m=0.012."""

    def main(self) -> None:
        """Run it."""
        from surefoot.cli.run import run_command

        run_command(self.scenario, self.controller, as_json=self.json, out=self.out, changes=self.set)


@dataclass(frozen=True)
class Dashboard:
    """Open the page: Bip on one foot, controllers to toggle, stones to drop."""

    port: int | None = None
    """Port to serve on; by default the first free one from 8080."""
    host: str = "127.0.0.1"
    """Address to listen on. Anything but this machine needs --token."""
    token: str | None = None
    """Secret that a page must bring as ?token=... when the server listens on other addresses."""
    scenario: str = "stand_left"
    """Shipped scenario or TOML file to start with."""
    controller: str = "two-part"
    """Controller to start with."""

    def main(self) -> None:
        """Serve it."""
        from surefoot.dashboard.launch import serve

        serve(host=self.host, port=self.port, token=self.token, scenario=self.scenario, controller=self.controller)


@dataclass(frozen=True)
class Replay:
    """Open a saved run (from the page or from surefoot run --out) as a page to scrub through, or convert it."""

    file: tyro.conf.Positional[Path]
    """A saved run: .npz or .parquet."""
    out: Path | None = None
    """Write a file instead: .html a page that opens from disk, .mcap for Foxglove, .npz, .parquet."""
    port: int | None = None
    """Port to serve on; by default the first free one from 8080."""
    host: str = "127.0.0.1"
    """Address to listen on. Anything but this machine needs --token."""
    token: str | None = None
    """Secret that a page must bring as ?token=... when the server listens on other addresses."""

    def main(self) -> None:
        """Serve or write it."""
        from surefoot.cli.replay import replay_command

        replay_command(self.file, out=self.out, host=self.host, port=self.port, token=self.token)


@dataclass(frozen=True)
class Plan:
    """Plan a scenario's swing: delta_P and ZMP over time, and where that ZMP leaves the sole. Nothing is simulated."""

    scenario: tyro.conf.Positional[str]
    """A TOML scenario file, or the name of a shipped scenario."""
    out: Path | None = None
    """Also write the plan as .csv."""
    set: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Change the scenario, e.g. --set reference.amplitude_m=-0.02."""

    def main(self) -> None:
        """Plan it."""
        from surefoot.cli.run import plan_command

        plan_command(self.scenario, out=self.out, changes=self.set)


@dataclass(frozen=True)
class Grid:
    """Run outer-edge stones and inward swings of growing size under every controller; print where each falls."""

    torque_limits: bool = True
    """The plant's motors saturate."""
    workers: int = 2
    """Processes."""
    out: Path | None = None
    """Also write every summary as a JSON list."""

    def main(self) -> None:
        """Run them."""
        from surefoot.cli.run import grid_command

        grid_command(torque_limits=self.torque_limits, workers=self.workers, out=self.out)


@dataclass(frozen=True)
class Figures:
    """Rerun the paper: Figures 1 and 5 to 9, judged claims, gain sweep and a report that can be read alone."""

    out: Path = Path("out/figures")
    """Folder to write into."""
    workers: int = 2
    """Processes."""

    def main(self) -> None:
        """Make them."""
        from surefoot.cli.figures import figures_command

        figures_command(out=self.out, workers=self.workers)


@dataclass(frozen=True)
class Ablate:
    """Change every switch of the equations, one at a time, over a fixed set of scenarios; print and plot the table."""

    out: Path = Path("out/ablation")
    """Folder to write into."""
    workers: int = 2
    """Processes."""

    def main(self) -> None:
        """Run them."""
        from surefoot.cli.figures import ablate_command

        ablate_command(out=self.out, workers=self.workers)


@dataclass(frozen=True)
class Bench:
    """Find the largest swing, stone, push and slope that each controller survives; rank them. Resumable."""

    controllers: str = ""
    """Comma-separated; +key=value changes a setting of one: two-part,soft-qp+guard=true. All registered by default."""
    families: str = ""
    """Comma-separated: swing, stone, landing, push, push-double, trunk, stone-push, slope, tilt. All by default."""
    quick: bool = False
    """Coarse levels and fewer cases: some minutes."""
    seeds: int = 1
    """Runs of every case with small random changes of onset, place and direction; seed 0 is the case as designed."""
    first_seed: int = 0
    """First seed, e.g. to judge on seeds that were not used for tuning."""
    vary_plant: bool = False
    """Mass, friction and delay of the plant vary with the seed too."""
    every_level: bool = False
    """Run every level instead of bisecting."""
    workers: int = 2
    """Processes, or workers of a local cluster."""
    cluster: str = ""
    """Address of a Dask scheduler (tcp://HOST:8786), or local to start one here; needs surefoot[cluster]."""
    out: Path = Path("out/bench")
    """Folder: finished cells, bench.parquet, manifest.json. The same command, or one with more seeds or
    controllers, goes on where it stopped; from the table alone too."""
    set: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Change a setting or the plant for all, e.g. --set controller.com_stiffness=80 --set physics.friction=0.6."""
    each_case: bool = False
    """Also print every case: the median of the largest survived and its range over seeds."""
    replay: int | None = None
    """Run nothing: write the scenario of this row (from 0) of the table in --out, for surefoot run."""
    report: bool = False
    """Run nothing: write the page (Markdown) about the finished bench in --out."""
    to: Path | None = None
    """With --replay or --report: the file to write; standard output by default."""

    def main(self) -> None:
        """Run it, or write one of its scenarios or the page about it."""
        from surefoot.cli.bench import bench_command, replay_command, report_command
        from surefoot.experiments.bench.bench import BenchRequest

        if self.replay is not None:
            replay_command(self.out, self.replay, self.to)
            return
        if self.report:
            report_command(self.out, self.to)
            return
        families = tuple(name.strip() for name in self.families.split(",") if name.strip())
        request = BenchRequest(
            controllers=self.controllers, families=families, quick=self.quick, seeds=self.seeds,
            first_seed=self.first_seed, vary_plant=self.vary_plant, every_level=self.every_level, changes=self.set,
        )  # fmt: skip
        bench_command(request, folder=self.out, workers=self.workers, cluster=self.cluster, each_case=self.each_case)


@dataclass(frozen=True)
class Map:
    """Draw maps of survival beside what physics allows: stones over the sole, pushes all around, swings."""

    bench: Path | None = None
    """Folder of a finished surefoot bench to draw; without it the map makes its own runs, on coarse levels."""
    controllers: str = ""
    """Comma-separated, side by side: two-part,soft-qp+guard=true. All registered by default (--quick: two)."""
    quick: bool = False
    """Fewer runs: two controllers, one foot, swings inward and forward; some minutes."""
    workers: int = 2
    """Processes."""
    out: Path = Path("out/map")
    """Folder for pictures (png, svg), map.html and the runs. The same command goes on where it stopped."""

    def main(self) -> None:
        """Draw them."""
        from surefoot.cli.map import map_command

        map_command(
            bench=self.bench, out=self.out, controllers=self.controllers, quick=self.quick, workers=self.workers
        )


@dataclass(frozen=True)
class Equations:
    """Print which function owns which equation of the paper."""

    def main(self) -> None:
        """Print it."""
        from surefoot.equation_ledger import markdown_table

        print(markdown_table())


@dataclass(frozen=True)
class Settings:
    """Print every gain and switch of the controllers with range, unit, equation and help."""

    def main(self) -> None:
        """Print it."""
        from surefoot.cli.run import print_settings

        print_settings()


Command = (
    Annotated[Dashboard, tyro.conf.subcommand("dashboard")]
    | Annotated[Run, tyro.conf.subcommand("run")]
    | Annotated[Replay, tyro.conf.subcommand("replay")]
    | Annotated[Plan, tyro.conf.subcommand("plan")]
    | Annotated[Grid, tyro.conf.subcommand("grid")]
    | Annotated[Figures, tyro.conf.subcommand("figures")]
    | Annotated[Ablate, tyro.conf.subcommand("ablate")]
    | Annotated[Bench, tyro.conf.subcommand("bench")]
    | Annotated[Map, tyro.conf.subcommand("map")]
    | Annotated[Settings, tyro.conf.subcommand("settings")]
    | Annotated[Equations, tyro.conf.subcommand("equations")]
)


def main(arguments: list[str] | None = None) -> None:
    """Parse, run, and turn the errors a person can cause into one line and exit code 2."""
    command = tyro.cli(Command, prog="surefoot", description=__doc__, args=arguments)  # type: ignore[call-overload]
    try:
        command.main()
    except SurefootError as error:
        print(f"surefoot: {error}", file=sys.stderr)
        raise SystemExit(2) from None
    except ImportError as error:
        if error.name is None or error.name.split(".")[0] == "surefoot":
            raise
        found = f" (found at {error.path})" if error.path else ""
        print(f"surefoot: a library cannot be used: {error}{found}; see PYTHONPATH", file=sys.stderr)
        raise SystemExit(2) from None
    except KeyboardInterrupt:
        raise SystemExit(130) from None
    except BrokenPipeError:
        sys.stderr.close()
        raise SystemExit(141) from None
