"""``surefoot replay``: a saved run as a page, or turned into another kind of file."""

from dataclasses import dataclass, field
from pathlib import Path

import tyro


@dataclass(frozen=True)
class Replay:
    """Open a saved run (from the page or from surefoot run --out) as a page to scrub through, or convert it."""

    file: tyro.conf.Positional[Path]
    """A saved run: .npz or .parquet, or the .partial that an interrupted one left."""
    out: Path | None = None
    """Write a file instead: .html a page that opens from disk, .mcap for Foxglove, .npz, .parquet."""
    robot: str | None = None
    """Where the robot's file lies now, if not where it lay when the run was made."""
    port: int | None = None
    """Port to serve on; by default the first free one from 8080."""
    host: str = "127.0.0.1"
    """Address to listen on. Anything but this machine needs --token."""
    token: str | None = None
    """Secret that a page must bring as ?token=... when the server listens on other addresses."""
    allow_origin: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Address of a proxy before the page, as the browser shows it: https://robot.example.org. May be repeated."""

    def main(self) -> None:
        """Serve or write it. Raises InvalidInput."""
        if self.out is None:
            from surefoot.dashboard.replay.replay_page import serve_replay

            serve_replay(
                self.file,
                robot=self.robot,
                host=self.host,
                port=self.port,
                token=self.token,
                allow_origin=self.allow_origin,
            )
        else:
            _convert(self.file, self.out, self.robot)


def _convert(file: Path, out: Path, robot: str | None) -> None:
    from surefoot.cli.console import tell_notes
    from surefoot.dashboard.replay.html_export import replay_html
    from surefoot.experiments.runs.mcap_file import mcap_bytes
    from surefoot.experiments.runs.robot_files import with_robot
    from surefoot.experiments.runs.run_reader import read_run
    from surefoot.experiments.runs.run_writer import npz_bytes, parquet_bytes
    from surefoot.output_files import check_kind, check_writable, write_file, writing

    makers = {
        ".html": lambda run: replay_html(run).encode(),
        ".mcap": mcap_bytes,
        ".npz": npz_bytes,
        ".parquet": parquet_bytes,
    }
    check_kind(out, makers)
    check_writable(out)
    run = with_robot(read_run(file), robot)
    tell_notes(run.manifest)
    content = makers[out.suffix](run)
    with writing(out):
        write_file(out, content)
