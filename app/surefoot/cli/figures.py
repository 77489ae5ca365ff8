"""``surefoot figures``: the paper rerun, and which of its claims hold."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Figures:
    """Rerun the paper: Figures 1 and 5 to 9, judged claims, gain sweep and a report that can be read alone."""

    out: Path = Path("out/figures")
    """Folder to write into."""
    workers: int = 2
    """Processes."""

    def main(self) -> None:
        """Make them. Raises InvalidInput."""
        from rich.console import Console
        from rich.table import Table

        from surefoot.cli.console import check_workers, output_folder, progress_bar
        from surefoot.experiments.paper.claims import ClaimVerdict
        from surefoot.experiments.paper.make_report import make_report
        from surefoot.experiments.paper.plan import full_plan

        check_workers(self.workers)
        with output_folder(self.out), progress_bar() as bar:
            task = bar.add_task("runs", total=1.0)
            judged = make_report(
                full_plan(),
                self.out,
                self.workers,
                lambda what, done: bar.update(task, description=what, completed=done),
            )
        colours = {
            ClaimVerdict.REPRODUCED: "green",
            ClaimVerdict.CALIBRATED: "cyan",
            ClaimVerdict.PARTLY: "yellow",
            ClaimVerdict.NOT: "red",
        }
        table = Table("claim of the paper", "verdict", box=None)
        for judgement in judged:
            table.add_row(judgement.claim.text, f"[{colours[judgement.verdict]}]{judgement.verdict}[/]")
        console = Console()
        console.print(table)
        console.print(
            f"figures (png, svg), report.md, report.html, results.json and raw/ are in {self.out}", soft_wrap=True
        )
