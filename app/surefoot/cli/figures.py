"""``surefoot figures``: the paper rerun, and which of its claims hold."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from surefoot.experiments.paper.claims import Judgement


@dataclass(frozen=True)
class Figures:
    """Rerun the paper: Figures 1 and 5 to 9, steps onto stones, judged claims, gain sweep, and a report of its own."""

    out: Path = Path("out/figures")
    """Folder to write into."""
    workers: int = 2
    """Processes."""

    def main(self) -> None:
        """Make them. Raises InvalidInput."""
        from rich.console import Console

        from surefoot.cli.console import check_workers, progress_bar
        from surefoot.experiments.paper.claims import judge
        from surefoot.experiments.paper.make_report import CLAIMS, gather, write_report
        from surefoot.experiments.paper.plan import full_plan
        from surefoot.output_files import check_folder, writing

        check_workers(self.workers)
        check_folder(self.out)
        with progress_bar() as bar:
            task = bar.add_task("runs", total=1.0)

            def progress(what: str, done: float) -> None:
                bar.update(task, description=what, completed=done)

            findings = gather(full_plan(), self.workers, progress)
            judged = judge(CLAIMS, findings)
            try:
                with writing(self.out):
                    write_report(findings, judged, self.out, progress)
            finally:  # a full disk does not keep back what was computed
                bar.stop()
                _print_verdicts(judged)
        Console().print(
            f"figures (png, svg), report.md, report.html, results.json and raw/ are in {self.out}", soft_wrap=True
        )


def _print_verdicts(judged: "tuple[Judgement, ...]") -> None:
    from rich.console import Console
    from rich.table import Table

    from surefoot.experiments.paper.claims import ClaimVerdict

    colours = {
        ClaimVerdict.REPRODUCED: "green",
        ClaimVerdict.CALIBRATED: "cyan",
        ClaimVerdict.PARTLY: "yellow",
        ClaimVerdict.NOT: "red",
    }
    table = Table("claim of the paper", "verdict", box=None)
    for judgement in judged:
        table.add_row(judgement.claim.text, f"[{colours[judgement.verdict]}]{judgement.verdict}[/]")
    Console().print(table)
