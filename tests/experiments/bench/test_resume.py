"""Nothing finished is ever done again or lost: by an exception, by Ctrl-C, by a killed program, by a killed worker."""

import shutil
import signal
import time

import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.cell_runner import run_cell
from surefoot.experiments.bench.store import MANIFEST, TABLE, read_table
from surefoot.experiments.runs.table_file import write_parquet


def finished(folder) -> dict[str, int]:
    return {file.name: file.stat().st_mtime_ns for file in (folder / "cells").glob("*.json")}


def test_a_finished_bench_runs_nothing_again(tiny, finished_tiny):
    def never(cell):
        raise AssertionError(f"{cell.case.name} was run again")

    before = (finished_tiny / TABLE).read_bytes()
    tiny.run_bench(tiny.tiny_bench(), finished_tiny, workers=1, task=never)
    assert (finished_tiny / TABLE).read_bytes() == before


def test_after_an_interruption_only_the_rest_is_run(tiny, finished_tiny, tmp_path):
    bench, ran = tiny.tiny_bench(), []

    def interrupted_at_the_third(cell):
        if len(ran) == 2:
            raise KeyboardInterrupt
        ran.append(cell.key)
        return run_cell(cell)

    with pytest.raises(KeyboardInterrupt):
        tiny.run_bench(bench, tmp_path, workers=1, task=interrupted_at_the_third)
    assert len(finished(tmp_path)) == 2
    assert '"complete": false' in (tmp_path / MANIFEST).read_text()

    again, seen = [], []

    def counted(cell):
        again.append(cell.key)
        return run_cell(cell)

    tiny.run_bench(bench, tmp_path, workers=1, task=counted, on_cell=lambda done, total: seen.append((done, total)))
    assert not set(again) & set(ran)
    assert len(again) == len(bench.cells) - 2
    assert seen[0] == (2, len(bench.cells))
    assert seen[-1] == (len(bench.cells), len(bench.cells))
    assert (tmp_path / TABLE).read_bytes() == (finished_tiny / TABLE).read_bytes()
    assert '"complete": true' in (tmp_path / MANIFEST).read_text()


def test_a_bench_goes_on_from_a_table_alone(tiny, finished_tiny, tmp_path):
    shutil.copy(finished_tiny / TABLE, tmp_path)
    bench, ran = tiny.tiny_bench(), []

    def counted(cell):
        ran.append(cell.key)
        return run_cell(cell)

    tiny.run_bench(bench, tmp_path, workers=1, task=counted)
    assert not ran
    assert (tmp_path / TABLE).read_bytes() == (finished_tiny / TABLE).read_bytes()
    fewer = type(bench)(request=bench.request, entries=bench.entries, cells=bench.cells[:1])
    tiny.run_bench(fewer, tmp_path, workers=1, task=counted)
    tiny.run_bench(bench, tmp_path, workers=1, task=counted)  # a smaller table in between has lost nothing
    assert not ran
    assert (tmp_path / TABLE).read_bytes() == (finished_tiny / TABLE).read_bytes()


@pytest.mark.parametrize("text", [b"", b"PAR1 and no more", None])
def test_a_foreign_table_is_told_before_anything_runs(text, tiny, tmp_path):
    if text is None:
        write_parquet(tmp_path / TABLE, {"other": [1.0]}, {})
    else:
        (tmp_path / TABLE).write_bytes(text)
    with pytest.raises(InvalidInput, match=r"bench\.parquet.*move it away"):
        tiny.run_bench(tiny.tiny_bench(), tmp_path, workers=1)


@pytest.mark.parametrize(
    ("workers", "how"),
    [
        (2, signal.SIGKILL),
        pytest.param(1, signal.SIGKILL, marks=pytest.mark.slow),
        pytest.param(2, signal.SIGINT, marks=pytest.mark.slow),
    ],
)
def test_a_killed_bench_goes_on_where_it_stopped(workers, how, start_tiny, finished_tiny, tmp_path):
    first = start_tiny(tmp_path, workers)
    deadline = time.monotonic() + 60.0
    while len(finished(tmp_path)) < 2 and first.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    first.send_signal(how)
    first.wait(timeout=60)
    before = finished(tmp_path)
    assert len(before) >= 2
    assert not (tmp_path / TABLE).exists(), "it was killed too late to show anything"

    second = start_tiny(tmp_path, workers)
    assert second.wait(timeout=120) == 0
    assert {name: when for name, when in finished(tmp_path).items() if name in before} == before
    assert (tmp_path / TABLE).read_bytes() == (finished_tiny / TABLE).read_bytes()


def test_a_killed_worker_costs_nothing_but_its_cell(start_tiny, finished_tiny, tmp_path):
    flag = tmp_path / "killed"
    assert start_tiny(tmp_path, 2, flag).wait(timeout=120) == 0
    assert flag.exists()
    assert (tmp_path / TABLE).read_bytes() == (finished_tiny / TABLE).read_bytes()


def test_what_another_code_or_setting_made_is_not_used(tiny, finished_tiny):
    bench = tiny.tiny_bench()
    other = [type(cell)(**{**cell.__dict__, "code": "y"}) for cell in bench.cells]
    slower = [type(cell)(**{**cell.__dict__, "settings": {"com_stiffness": 50.0}}) for cell in bench.cells]
    keys = {cell.key for cell in (*bench.cells, *other, *slower)}
    assert len(keys) == 3 * len(bench.cells)
    assert len(read_table(finished_tiny)) >= len(bench.cells)
