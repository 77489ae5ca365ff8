"""``surefoot bench``: the largest disturbance that each controller survives; its scenarios and the page about it."""

import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

if TYPE_CHECKING:
    from surefoot.experiments.bench.bench import BenchRequest


@dataclass(frozen=True)
class Bench:
    """Find the largest swing, stone, push and slope that each controller survives; rank them. Resumable.

    It costs time: a cell, one case of one controller and seed, is some 5 episodes of 3.5 s, for Bip 7 to 14 s of one
    core. A controller has 102 cells a seed, 11 to 22 minutes of one core; with --quick 28, 2 to 4 minutes; with
    --families walk 44 longer ones, 19 to 38 minutes.
    """

    controllers: str = ""
    """Comma-separated; +key=value changes a setting of one: two-part,soft-qp+guard=true, or with a dot in its key the
    scenario: two-part+motors.bandwidth_hz=40+motors.coulomb_share=0.02. All registered by default."""
    presets: str = ""
    """Comma-separated, a column each under every controller: perfect,lab,robot,cheap, of sensors, motors and model
    error. A cell's seed is that of their noise and errors too."""
    estimator: str = "anchor"
    """What reads the sensors of --presets: anchor, invariant-ekf, or one that an installed package brings."""
    families: str = ""
    """Comma-separated: swing, stone, landing, push, push-double, trunk, stone-push, slope, tilt; these by default.
    stand: nothing happens, for robots that do not know their state. Of robots that step: walk-stones, walk-tiles,
    walk-ledge, walk-flat, walk-long, walk-slope, walk-turn, walk-starts, walk-push, step-push, step-onto-stone; walk
    for all of them.
    """
    robot: str = "bip"
    """Whose balance: a name, or the path of an MJCF, URDF or robot.toml (surefoot robot check). Levels and stones are
    in proportion to it; finished cells of another state of its files are not used again."""
    quick: bool = False
    """Coarse levels and fewer cases: some minutes a controller."""
    seeds: int = 1
    """Runs of every case with small random changes of onset, place and direction; seed 0 is the case as designed.
    Stones under steps, tiles and the place of a ledge are drawn anew by each."""
    first_seed: int = 0
    """First seed, e.g. to judge on seeds that were not used for tuning."""
    vary_plant: bool = False
    """Mass, friction and delay of the plant vary with the seed too."""
    levels: str = ""
    """Comma-separated levels to play instead of the families' own, each with every seed, in the families' unit (m, deg,
    N s, J/J_cap or J/J_cap1): --families walk-stones --levels 0.02 --seeds 100 --first-seed 100. They are played as
    they are said, whatever the robot: --robot g1.xml --families stone --levels 0.005,0.01 is 5 mm and 10 mm."""
    goals: bool = False
    """Play the figures that walks are to reach, instead of families: stones, tiles, ledges, slopes, turns, long walks
    and pushes, each at one level, seed by seed."""
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
    """Change a setting or the plant for all, e.g. --set controller.com_stiffness=80 --set physics.friction=0.6, or
    --set sensors.preset=robot --set estimator.kind=anchor."""
    each_case: bool = False
    """Also print every case: the median of the largest survived and its range over seeds."""
    replay: int | None = None
    """Run nothing: write the scenario of this row (from 0) of the table in --out, for surefoot run."""
    report: bool = False
    """Run nothing: write the page (Markdown) about the finished bench in --out."""
    to: Path | None = None
    """With --replay or --report: the file to write; standard output by default."""

    def main(self) -> None:
        """Run it, or write one of its scenarios or the page about it. Raises InvalidInput.

        Exit code 1 when a ledger does not add up.
        """
        if self.replay is not None:
            self._write_scenario(self.replay)
        elif self.report:
            self._write_report()
        else:
            self._run()
            self._print_tables()

    def _write_scenario(self, row: int) -> None:
        from surefoot.errors import InvalidInput
        from surefoot.experiments.bench.rerun_cell import scenario_of_row
        from surefoot.experiments.bench.store import read_manifest, read_table

        rows = read_table(self.out)
        if not 0 <= row < len(rows):
            raise InvalidInput("--replay", row, "no such row", [f"0 to {len(rows) - 1}"])
        _write_text(scenario_of_row(rows[row], read_manifest(self.out)), self.to)
        if self.to is not None:
            print(f"surefoot run {self.to} --controller {rows[row]['registry_name']}", file=sys.stderr)

    def _write_report(self) -> None:
        from surefoot.experiments.bench.report import bench_page, read_bench

        _write_text(bench_page(*read_bench(self.out)), self.to)

    def _request(self) -> "BenchRequest":
        from surefoot.experiments.bench.bench import BenchRequest
        from surefoot.experiments.bench.entries import with_presets

        presets = [name.strip() for name in self.presets.split(",") if name.strip()]
        return BenchRequest(
            controllers=with_presets(self.controllers, presets, self.estimator) if presets else self.controllers,
            families=tuple(name.strip() for name in self.families.split(",") if name.strip()),
            quick=self.quick,
            seeds=self.seeds,
            first_seed=self.first_seed,
            vary_plant=self.vary_plant,
            every_level=self.every_level,
            changes=self.set,
            levels=self._levels(),
            goals=self.goals,
            robot=self.robot,
        )

    def _levels(self) -> tuple[float, ...]:
        from surefoot.errors import InvalidInput

        try:
            return tuple(float(level) for level in self.levels.split(",") if level.strip())
        except ValueError:
            raise InvalidInput("--levels", self.levels, "must be numbers", ["0.01,0.02"]) from None

    def _run(self) -> None:
        from surefoot.cli.bench_progress import run_and_tell
        from surefoot.cli.console import tell_unavailable_controllers
        from surefoot.experiments.bench.bench import plan_bench

        if not self.controllers:
            tell_unavailable_controllers()
        run_and_tell(plan_bench(self._request()), "bench", self.out, workers=self.workers, cluster=self.cluster)

    def _print_tables(self) -> None:
        from surefoot.cli.bench_tables import (
            print_cases,
            print_crashes,
            print_endings,
            print_ledger,
            print_ranking,
            print_shares,
            print_walk_pushes,
        )
        from surefoot.experiments.bench.goal_table import goals_reached
        from surefoot.experiments.bench.ranking import not_adding_up
        from surefoot.experiments.bench.report import read_bench
        from surefoot.experiments.bench.store import read_table

        rows = read_table(self.out)
        if self.goals:
            print("\n".join(goals_reached(*read_bench(self.out))))
            return
        print_ranking(rows)
        if self.each_case:
            print_cases(rows)
        print_shares(rows)
        print_walk_pushes(rows)
        print_endings(rows)
        print_ledger(rows)
        print_crashes(rows)
        if not_adding_up(rows):
            raise SystemExit(1)


def _write_text(text: str, out: Path | None) -> None:
    from surefoot.output_files import check_writable, write_file, writing

    if out is None:
        print(text, end="")
        return
    check_writable(out, "--to")
    with writing(out, "--to"):
        write_file(out, text)
