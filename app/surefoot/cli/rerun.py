"""``surefoot rerun``: whether a result comes out the same again, from its file alone."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tyro


@dataclass(frozen=True)
class Rerun:
    """Make a saved run, or a cell of a bench, again and compare to the bit. Exit code 0 when equal, 1 when not."""

    file: tyro.conf.Positional[Path]
    """A saved run (.npz, .parquet, the .partial of an interrupted one), or the folder of a finished surefoot bench."""
    row: int = 0
    """Of a bench: whose cell, by a row (from 0) of its table."""

    def main(self) -> None:
        """Do it. Raises InvalidInput, PostureError, ControllerError."""
        what, different, made_by = self._bench_cell() if self.file.is_dir() else self._saved_run()
        if different is None:
            print(f"equal: {what}")
            return
        print(f"different: {what}: {different}")
        for line in _other_origin(made_by):
            print(f"surefoot: {line}", file=sys.stderr)
        raise SystemExit(1)

    def _saved_run(self) -> tuple[str, str | None, Mapping[str, Any]]:
        from surefoot.cli.console import progress_bar, tell_notes
        from surefoot.dashboard.live.rerun import rerun
        from surefoot.experiments.runs.comparison import difference
        from surefoot.experiments.runs.run_reader import read_run

        kept = read_run(self.file)
        about = kept.manifest
        tell_notes(about)
        what = f"{about['scenario_name']} under {about['controller']}, {len(kept.table)} ticks"
        with progress_bar() as bar:
            task = bar.add_task("again", total=1.0)
            again = rerun(kept, lambda done: bar.update(task, completed=done))
        return what, difference(kept, again), about

    def _bench_cell(self) -> tuple[str, str | None, Mapping[str, Any]]:
        from surefoot.errors import InvalidInput
        from surefoot.experiments.bench.rerun_cell import rerun_cell
        from surefoot.experiments.bench.store import read_manifest, read_table

        rows, manifest = read_table(self.file), read_manifest(self.file)
        if not 0 <= self.row < len(rows):
            raise InvalidInput("--row", self.row, "no such row", [f"0 to {len(rows) - 1}"])
        row = rows[self.row]
        what = f"{row['family']} {row['case']} under {row['controller']}, seed {row['seed']}"
        return what, rerun_cell(row["cell"], rows, manifest), {**manifest, "git_commit": manifest.get("commit")}


def _other_origin(made_by: Mapping[str, Any]) -> list[str]:
    """What may be why: another commit, other versions."""
    from surefoot.experiments.runs.provenance import git_commit, versions

    then, now = made_by.get("versions") or {}, versions()
    lines = [f"{name} was {then[name]}, is {now.get(name)}" for name in then if then[name] != now.get(name)]
    if made_by.get("git_commit") != git_commit():
        lines.append(f"commit was {made_by.get('git_commit')}, is {git_commit()}")
    return lines
