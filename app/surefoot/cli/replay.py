"""``surefoot replay``: a saved run as a page, or turned into another kind of file."""

from pathlib import Path

from surefoot.dashboard.replay.html_export import replay_html
from surefoot.dashboard.replay.replay_page import serve_replay
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.mcap_file import mcap_bytes
from surefoot.experiments.runs.saved_run import npz_bytes, parquet_bytes, read_run

_MAKERS = {
    ".html": lambda run: replay_html(run).encode(), ".mcap": mcap_bytes, ".npz": npz_bytes, ".parquet": parquet_bytes,
}  # fmt: skip


def replay_command(file: Path, *, out: Path | None, host: str, port: int | None, token: str | None) -> None:
    """Serve it, or write it to ``out``. Raises InvalidInput."""
    if out is None:
        serve_replay(file, host=host, port=port, token=token)
        return
    if out.suffix not in _MAKERS:
        raise InvalidInput("--out", str(out), "unknown kind of file", _MAKERS)
    content = _MAKERS[out.suffix](read_run(file))
    try:
        out.write_bytes(content)
    except OSError as error:
        raise InvalidInput("--out", str(out), f"cannot be written: {error.strerror}") from None
