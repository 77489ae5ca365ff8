"""What a killed run leaves: whatever was cut off or damaged, the rows before it are right."""

import json

import numpy as np
import pytest

from surefoot import run
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.partial_file import PartialRun, PartialWriter
from surefoot.experiments.runs.run_reader import read_run

ROWS, BATCH = 60, 10


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A run, and the bytes of its file as it grew: after every batch, and whole."""
    done = run("stone_outer_edge", changes={"duration_s": ROWS * 1e-3})
    path = tmp_path_factory.mktemp("made") / "run.npz.partial"
    first = {**done.manifest, "summary": {}, "events": [[0.03, "push", "planned"], [9.0, "push", "to come"]]}
    writer = PartialWriter(path, done.columns, first)
    grown = [path.read_bytes()]
    for start in range(0, ROWS, BATCH):
        writer.add(done.table[start : start + BATCH], [(0.001 * start, "limit", "passed")])
        grown.append(path.read_bytes())
    writer.finish(done.manifest)
    writer.close()
    return done, grown, path.read_bytes()


@pytest.fixture
def opened(tmp_path):
    """Bytes -> the run that opens, or None where it is refused in one line."""

    def attempt(content: bytes):
        file = tmp_path / "left.npz.partial"
        file.write_bytes(content)
        try:
            return read_run(file)
        except InvalidInput as error:
            assert "\n" not in str(error)
            assert "left.npz.partial" in str(error)
            return None

    return attempt


def test_it_opens_at_every_batch(made, opened):
    done, grown, whole = made
    assert opened(grown[0]) is None  # it has a manifest, and no tick yet
    for batches, content in enumerate(grown[1:], 1):
        left = opened(content)
        assert left.table.tobytes() == done.table[: batches * BATCH].tobytes()
        assert left.manifest["interrupted_s"] == left.column("time_s")[-1]
        planned = ["planned"] if batches * BATCH > 31 else []
        texts = {text for _, _, text in left.manifest["events"]}
        assert texts == {*planned, "passed", "interrupted: the record ends here"}
    assert opened(whole).manifest == json.loads(json.dumps(done.manifest))  # as at its end, not interrupted


def test_it_may_be_cut_anywhere(made, opened):
    done, grown, whole = made
    random = np.random.default_rng(2)
    for size in {0, 1, 8, *random.integers(0, len(whole), 100)}:
        left = opened(whole[:size])
        batches = sum(len(content) <= size for content in grown) - 1
        assert (left is None) == (batches < 1)
        if left is not None:
            assert left.table.tobytes() == done.table[: batches * BATCH].tobytes()


def test_a_tail_that_never_reached_the_disk_is_left_out(made, opened):
    """After a power cut a file may be as long as it was to be, and hold nothing there."""
    done, grown, _ = made
    for lost in (len(grown[4]) - 17, len(grown[4]) - 1000, len(grown[3])):
        left = opened(grown[4][:lost] + bytes(len(grown[5]) - lost))
        assert left.table.tobytes() == done.table[: 3 * BATCH].tobytes()


def test_every_byte_may_be_wrong(made, opened):
    done, _, whole = made
    random = np.random.default_rng(4)
    for position in random.integers(0, len(whole), 150):
        damaged = bytearray(whole)
        damaged[position] ^= 1 << int(random.integers(8))
        left = opened(bytes(damaged))
        if left is not None:
            assert left.table.tobytes() == done.table[: len(left.table)].tobytes()


@pytest.mark.parametrize("content", [b"", b"text", b"PAR1", b"PK\x03\x04", bytes(1000), b"\xff" * 1000])
def test_what_is_none_is_refused(opened, content):
    assert opened(content) is None


def test_one_that_is_there_is_never_written_over(tmp_path):
    (tmp_path / "run.npz.partial").write_text("precious")
    with pytest.raises(FileExistsError):
        PartialWriter(tmp_path / "run.npz.partial", ["time_s"], {})
    assert (tmp_path / "run.npz.partial").read_text() == "precious"


def test_it_is_opened_some_rows_at_a_time(made, tmp_path):
    (tmp_path / "run.npz.partial").write_bytes(made[2])
    assert [len(rows) for rows in PartialRun(tmp_path / "run.npz.partial").batches() if len(rows)] == [BATCH] * 6
