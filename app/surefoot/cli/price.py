"""``surefoot price``: what each imperfection of a robot costs."""

from dataclasses import dataclass, field
from pathlib import Path

import tyro


@dataclass(frozen=True)
class Price:
    """Turn on one imperfection of a preset at a time, then all together; print what is lost. Resumable.

    It costs time: as it stands 528 cells, 2 to 3 hours of one core; with --quick 288 shorter ones, 1 to 1.5 hours.
    """

    families: str = ""
    """Comma-separated: push-double, push, stone (these by default), walk-flat, walk-stones."""
    preset: str = "robot"
    """Whose imperfections of sensors, motors and model: lab, robot, cheap."""
    estimator: str = "anchor"
    """What reads the sensors: anchor, invariant-ekf, ...; truth leaves the sensors out."""
    imperfections: str = ""
    """Comma-separated, only these: imu-noise, imu-bias, encoders, joint-velocity, foot-noise, foot-bias, sampling,
    latency, torque-loop, motor-friction, motor-speed, masses, mass-centres, lengths, friction; or of your own:
    slow+physics.control_delay_s=0.002. All of the preset by default."""
    controllers: str = "two-part"
    """Comma-separated; +key=value changes a setting of one: two-part,soft-qp+guard=true."""
    quick: bool = False
    """Two cases a family and coarse levels."""
    seeds: int = 3
    """Seeds: each draws noise, biases and errors of the model anew, and moves every case a little (seed 0: not)."""
    first_seed: int = 0
    """First seed, e.g. to judge on seeds that were not used for tuning."""
    workers: int = 2
    """Processes, or workers of a local cluster."""
    cluster: str = ""
    """Address of a Dask scheduler (tcp://HOST:8786), or local to start one here; needs surefoot[cluster]."""
    out: Path = Path("out/price")
    """Folder: finished cells, table, price.md, price.json and the waterfalls price.png, .svg. The same command, or one
    with more seeds, goes on where it stopped."""
    set: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Change a setting or the plant of all, perfect too, e.g. --set controller.guard=false."""
    report: bool = False
    """Run nothing: print the finished list in --out, and write its page and pictures anew."""

    def main(self) -> None:
        """Run it, print and write the list. Raises InvalidInput."""
        from surefoot.experiments.price.page import write_price
        from surefoot.output_files import writing

        if not self.report:
            self._run()
        self._print_tables()  # a full disk does not keep back what was computed
        with writing(self.out):
            files = write_price(self.out)
        for file in files:
            print(file)

    def _run(self) -> None:
        from surefoot.cli.bench_progress import run_and_tell
        from surefoot.experiments.price.plan import PriceRequest, plan_price

        bench = plan_price(
            PriceRequest(
                families=_names(self.families),
                preset=self.preset,
                estimator=self.estimator,
                imperfections=_names(self.imperfections),
                controllers=self.controllers,
                quick=self.quick,
                seeds=self.seeds,
                first_seed=self.first_seed,
                changes=self.set,
            )
        )
        run_and_tell(bench, "price", self.out, workers=self.workers, cluster=self.cluster)

    def _print_tables(self) -> None:
        from rich.markup import escape
        from rich.table import Table

        from surefoot.cli.console import wide_console
        from surefoot.experiments.price.page import read_price
        from surefoot.experiments.price.plan import ABOUT
        from surefoot.experiments.price.words import COLUMNS, HOW, cells, tables, title

        found, manifest = read_price(self.out)
        console = wide_console()
        for group in tables(found):
            table = Table(*map(escape, COLUMNS), title=escape(title(group[0], manifest[ABOUT]["figures"])))
            for price in group:
                table.add_row(*map(escape, cells(price)))
            console.print(table)
        console.print(escape(HOW.replace("`", "")))


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())
