"""``surefoot grid``: where each controller falls, over stones and swings of growing size."""

import json
from dataclasses import dataclass
from pathlib import Path


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
        """Run them. Raises InvalidInput."""
        from surefoot.cli.console import check_workers, progress_bar, tell_unavailable_controllers
        from surefoot.experiments.studies.grid import grid_cells, markdown_tables, run_cells
        from surefoot.output_files import check_writable, write_file, writing

        check_workers(self.workers)
        if self.out is not None:
            check_writable(self.out)
        tell_unavailable_controllers()
        cells = grid_cells(torque_limits=self.torque_limits)
        with progress_bar() as bar:
            results = list(bar.track(run_cells(cells, self.workers), total=len(cells), description="grid"))
        try:
            if self.out is not None:
                rows = [{"row": cell.row, **summary} for cell, summary in results]
                with writing(self.out):
                    write_file(self.out, json.dumps(rows, indent=1, allow_nan=False) + "\n")
        finally:  # a full disk does not keep back what was computed
            print(markdown_tables(results))
