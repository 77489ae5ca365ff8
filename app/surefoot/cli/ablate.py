"""``surefoot ablate``: what every switch of the equations is worth."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Ablate:
    """Change every switch of the equations, one at a time, over a fixed set of scenarios; print and plot the table."""

    out: Path = Path("out/ablation")
    """Folder to write into."""
    workers: int = 2
    """Processes."""

    def main(self) -> None:
        """Run them. Raises InvalidInput."""
        from rich.console import Console

        from surefoot.cli.console import check_workers, progress_bar
        from surefoot.experiments.studies.ablation import (
            SCENARIOS,
            ablation_table,
            all_variants,
            run_ablation,
            write_ablation,
        )
        from surefoot.output_files import check_folder, writing

        check_workers(self.workers)
        check_folder(self.out)
        variants = all_variants()
        with progress_bar() as bar:
            runs = run_ablation(variants, SCENARIOS, self.workers)
            results = list(bar.track(runs, total=len(variants) * len(SCENARIOS), description="ablation"))
        try:
            with writing(self.out):
                write_ablation(results, self.out)
        finally:  # a full disk does not keep back what was computed
            print(ablation_table(results).markdown())
        Console().print(f"ablation.md, .png, .svg and .json are in {self.out}", soft_wrap=True)
