"""A run on its way into a file: how much is ever unwritten, how much memory it takes, and what a fault leaves."""

import errno
import os
import tracemalloc

import numpy as np
import pyarrow as pa
import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.runs.partial_file import PartialRun
from surefoot.experiments.runs.recording import BATCH_ROWS, Recording
from surefoot.experiments.runs.run_writer import WRITERS, npz_bytes, parquet_bytes, write_run
from surefoot.experiments.runs.saved_run import FORMAT, SavedRun
from surefoot.experiments.runs.table_file import csv_bytes, read_parquet_numbers

MANIFEST = {"format": FORMAT, "events": []}
SECOND = 1_000_000_000
POOLS = []  # of Arrow's memory: what was taken from one may be given back late


class Synthetic:
    """Rows as they would come, and a clock: made when they are asked for, not kept."""

    def __init__(self) -> None:
        self.columns, self.written, self.now = ["time_s", "x_m", "y_m", "z_m"], 0, 0

    def rows(self, first: int, last: int) -> np.ndarray:
        time_s = 1e-3 * np.arange(first, last)
        return np.column_stack((time_s, np.sin(time_s), np.cos(time_s), np.where(time_s < 0.1, np.nan, 1.0)))

    def last(self, rows: int) -> np.ndarray:
        assert rows <= BATCH_ROWS, "a recorder of that size has overwritten some of them"
        return self.rows(self.written - rows, self.written)

    def clock(self) -> int:
        return self.now


def recorded(out, rows: Synthetic, ticks: int, step: int = 1, manifest=MANIFEST) -> Recording:
    recording = Recording(out, rows.clock)
    with recording:
        recording.begin(rows, MANIFEST, tuple)
        for _ in range(0, ticks, step):
            rows.written += step
            recording.tick()
        recording.finish(manifest)
        recording.write_out()
    return recording


@pytest.mark.parametrize("kind", WRITERS)
def test_the_file_has_the_bytes_of_one_made_from_memory(tmp_path, kind):
    rows, out = Synthetic(), tmp_path / f"run{kind}"
    recorded(out, rows, 2 * BATCH_ROWS + 77)
    run = SavedRun(tuple(rows.columns), rows.rows(0, rows.written), MANIFEST)
    whole = {".npz": npz_bytes, ".parquet": parquet_bytes, ".csv": lambda run: csv_bytes(run.columns, run.table)}
    assert out.read_bytes() == whole[kind](run)
    assert list(tmp_path.iterdir()) == [out]


def test_never_more_than_a_batch_or_half_a_second_is_unwritten(tmp_path):
    rows, random = Synthetic(), np.random.default_rng(3)
    times = [0]  # of every tick, by the clock
    recording = Recording(tmp_path / "run.npz", rows.clock)
    with recording:
        recording.begin(rows, MANIFEST, tuple)
        for step in random.choice([1, 1000, SECOND // 20, SECOND // 3], size=2000, p=[0.5, 0.3, 0.15, 0.05]):
            rows.now += int(step)
            times.append(rows.now)
            rows.written += 1
            recording.tick()
            if rows.written % 40 == 0:
                there = PartialRun(recording.partial).rows
                assert rows.written - there < BATCH_ROWS
                assert there == rows.written or rows.now - times[there + 1] < SECOND // 2


def test_it_outlives_the_power_too_once_a_second(tmp_path, monkeypatch):
    rows, synced = Synthetic(), []
    monkeypatch.setattr(os, "fsync", lambda descriptor: synced.append(rows.now))
    recording = Recording(tmp_path / "run.npz", rows.clock)
    with recording:
        recording.begin(rows, MANIFEST, tuple)
        for _ in range(3000):
            rows.now += SECOND // 800
            rows.written += 1
            recording.tick()
    assert max(np.diff([*synced, rows.now])) <= SECOND


@pytest.mark.parametrize("kind", [".npz", ".parquet"])
def test_its_memory_does_not_grow_with_the_run(tmp_path, kind):
    peaks = {}
    for ticks in (50_000, 200_000):
        pool = pa.proxy_memory_pool(pa.default_memory_pool())
        POOLS.append(pool)
        pa.set_memory_pool(pool)
        tracemalloc.start()
        try:
            recorded(tmp_path / f"run{kind}", Synthetic(), ticks, step=100)
            peaks[ticks] = tracemalloc.get_traced_memory()[1] + pool.max_memory()
        finally:
            tracemalloc.stop()
            pa.set_memory_pool(pa.default_memory_pool())
    rows = 8 * len(Synthetic().columns) * np.diff(list(peaks))  # bytes that came on top
    assert np.diff(list(peaks.values())) < 0.25 * rows


def test_all_of_a_run_is_in_its_file_however_long_it_was(tmp_path):
    rows, out = Synthetic(), tmp_path / "run.parquet"
    recorded(out, rows, 130_000, step=BATCH_ROWS)
    _, table, _ = read_parquet_numbers(out)
    assert table.tobytes() == rows.rows(0, 130_000).tobytes()


def full(*_) -> None:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_full_disk_ends_the_record_in_one_line_and_leaves_what_was_written(tmp_path, monkeypatch):
    rows, out = Synthetic(), tmp_path / "run.npz"
    recording = Recording(out, rows.clock)
    with pytest.raises(InvalidInput) as refused, recording:
        recording.begin(rows, MANIFEST, tuple)
        for tick in range(2000):
            if tick == 1300:
                monkeypatch.setattr("surefoot.experiments.runs.partial_file.PartialWriter.sync", full)
            rows.now, rows.written = rows.now + SECOND // 500, rows.written + 1
            recording.tick()
        recording.finish(MANIFEST)
        recording.write_out()
    assert "No space left on device" in str(refused.value)
    assert str(recording.partial) in str(refused.value)
    left = PartialRun(recording.partial)
    assert left.rows > 1000
    assert np.concatenate(list(left.batches())).tobytes() == rows.rows(0, left.rows).tobytes()
    assert list(tmp_path.iterdir()) == [recording.partial]


def test_a_disk_that_is_full_at_the_end_leaves_the_whole_run(tmp_path, monkeypatch):
    rows, out = Synthetic(), tmp_path / "run.npz"
    monkeypatch.setattr("surefoot.experiments.runs.recording.write_run", full)
    with pytest.raises(InvalidInput, match="its first 1234 ticks are in"):
        recorded(out, rows, 1234, manifest={**MANIFEST, "summary": {"fell": False}})
    left = PartialRun(tmp_path / "run.npz.partial")
    assert left.rows == 1234
    assert left.manifest == {**MANIFEST, "summary": {"fell": False}}  # it came to its end: not interrupted
    write_run(left, out)
    assert out.exists()


def test_what_was_damaged_meanwhile_becomes_no_file(tmp_path):
    rows, out = Synthetic(), tmp_path / "run.npz"
    recording = Recording(out, rows.clock)
    with pytest.raises(InvalidInput, match="only 500 of them can be read again"), recording:
        recording.begin(rows, MANIFEST, tuple)
        for rows.written in range(1, 1201):
            recording.tick()
        recording.finish(MANIFEST)
        with recording.partial.open("r+b") as file:
            file.seek(-10_000, os.SEEK_END)
            file.write(bytes(10))
        recording.write_out()
    assert not out.exists()


def test_whatever_ends_the_run_its_last_ticks_are_written(tmp_path):
    rows = Synthetic()
    recording = Recording(tmp_path / "run.npz", rows.clock)
    with pytest.raises(RuntimeError), recording:
        recording.begin(rows, MANIFEST, tuple)
        rows.written = 123
        recording.tick()
        raise RuntimeError
    left = PartialRun(recording.partial)
    assert left.rows == 123
    assert left.manifest["interrupted_s"] == pytest.approx(0.122)


def test_what_earlier_runs_left_stays(tmp_path):
    first, second = tmp_path / "run.npz.partial", tmp_path / "run.npz.2.partial"
    first.write_text("one")
    second.write_text("two")
    recording = Recording(tmp_path / "run.npz", Synthetic().clock)
    assert recording.earlier() == [first, second]
    recorded(tmp_path / "run.npz", Synthetic(), 10)
    assert (first.read_text(), second.read_text()) == ("one", "two")
    assert len(list(tmp_path.iterdir())) == 3
