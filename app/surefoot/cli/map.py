"""``surefoot map``: maps of survival, of a finished bench or of runs of its own."""

import sys
from dataclasses import dataclass
from pathlib import Path

_RUNS = "runs"


@dataclass(frozen=True)
class Map:
    """Draw maps of survival beside what physics allows: stones over the sole, pushes all around, swings.

    Runs of its own cost time: of Bip 45 cells a controller, 3 to 6 minutes of one core; with --quick 46 in all.
    """

    bench: Path | None = None
    """Folder of a finished surefoot bench to draw; without it the map makes its own runs, on coarse levels."""
    controllers: str = ""
    """Comma-separated, side by side: two-part,soft-qp+guard=true. All registered by default (--quick: two)."""
    robot: str | None = None
    """Whose balance: a name, or the path of an MJCF, URDF or robot.toml; Bip's by default. With --bench: where the file
    lies now, if not where it lay."""
    quick: bool = False
    """Fewer runs: two controllers, one foot, swings inward and forward; some minutes."""
    workers: int = 2
    """Processes."""
    out: Path = Path("out/map")
    """Folder for pictures (png, svg), map.html and the runs. The same command goes on where it stopped."""

    def main(self) -> None:
        """Draw them. Raises InvalidInput."""
        from surefoot.cli.console import check_workers
        from surefoot.errors import InvalidInput
        from surefoot.experiments.bench.ladders import BIP
        from surefoot.experiments.bench.store import read_manifest, read_table
        from surefoot.experiments.maps.report import write_maps
        from surefoot.experiments.runs.robot_files import robot_note
        from surefoot.experiments.scenario.robots import check_robot
        from surefoot.output_files import check_folder, writing

        if self.bench is not None and (self.controllers or self.quick):
            reason = "a finished table is drawn as it is: leave out --controllers, --quick"
            raise InvalidInput("--bench", str(self.bench), reason)
        check_workers(self.workers)
        check_folder(self.out)
        bench = self.out / _RUNS if self.bench is None else self.bench
        if self.bench is None:
            self._run(bench)
        rows = read_table(bench)
        manifest = read_manifest(bench, "--bench")
        robot = check_robot(self.robot or manifest.get("arguments", {}).get("robot", BIP), files=True, folder=Path())
        if line := robot_note({"robot": robot, "robot_sha256": manifest.get("robot", {}).get("sha256")}):
            print(f"surefoot: {line}", file=sys.stderr)
        with writing(self.out):
            files = write_maps(rows, manifest, self.out, robot)
        for file in files:
            print(file)

    def _run(self, folder: Path) -> None:
        from surefoot.cli.console import cells_bar, tell_unavailable_controllers
        from surefoot.experiments.bench.bench import run_bench
        from surefoot.experiments.bench.ladders import BIP
        from surefoot.experiments.maps.data import plan_maps

        if not self.controllers:
            tell_unavailable_controllers()
        plan = plan_maps(self.controllers, quick=self.quick, robot=self.robot or BIP)
        with cells_bar() as bar:
            task = bar.add_task("maps", total=len(plan.cells))
            run_bench(
                plan,
                folder,
                workers=self.workers,
                on_cell=lambda done, total: bar.update(task, completed=done, total=total),
            )
