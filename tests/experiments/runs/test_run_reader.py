"""Whatever a file holds: it opens as a run that can be drawn, or is refused in one line."""

import io
import json
import zipfile

import numpy as np
import pytest

from surefoot import open_run, run
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import npz_bytes, parquet_bytes
from surefoot.experiments.runs.saved_run import SavedRun

SUFFIXES = {".npz": npz_bytes, ".parquet": parquet_bytes}


@pytest.fixture(scope="module")
def good() -> SavedRun:
    done = run("stone_outer_edge", changes={"duration_s": 0.02})
    return SavedRun(done.columns, done.table, json.loads(json.dumps(done.manifest)))


def refusal(tmp_path, name: str, content: bytes) -> str:
    file = tmp_path / name
    file.write_bytes(content)
    with pytest.raises(InvalidInput) as refused:
        read_run(file)
    text = str(refused.value)
    assert "\n" not in text
    assert name in text
    return text


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_what_is_no_such_file_is_refused(good, tmp_path, suffix):
    whole = SUFFIXES[suffix](good)
    refusal(tmp_path, f"empty{suffix}", b"")
    refusal(tmp_path, f"text{suffix}", b"time_s,com_x_m\n0.0,0.1\n")
    for share in (0.001, 0.1, 0.5, 0.9, 0.999):
        refusal(tmp_path, f"cut{suffix}", whole[: int(share * len(whole))])
    refusal(tmp_path, f"other{suffix}", SUFFIXES[".npz" if suffix == ".parquet" else ".parquet"](good))


def test_every_byte_may_be_wrong(good, tmp_path):
    """Some of these open (a byte that nothing reads); none raises anything else."""
    random = np.random.default_rng(5)
    for suffix, made in SUFFIXES.items():
        whole = made(good)
        for position in random.integers(0, len(whole), 150):
            file, damaged = tmp_path / f"damaged{suffix}", bytearray(whole)
            damaged[position] ^= 1 << int(random.integers(8))
            file.write_bytes(bytes(damaged))
            try:
                assert isinstance(read_run(file), SavedRun)
            except InvalidInput as error:
                assert "\n" not in str(error)


def test_numpy_s_other_kinds_of_file_are_refused(tmp_path):
    plain, pickled, foreign, packed = (io.BytesIO() for _ in range(4))
    np.save(plain, np.zeros(3))
    np.savez(pickled, table=np.array([{}], dtype=object), columns=["a"], manifest="{}")
    np.savez(foreign, weights=np.zeros(3))
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("table.npy", b"\x93NUMPY\x01\x00")
        archive.writestr("manifest.npy", b"no array")
        archive.writestr("columns.npy", b"")
    for name, file in {"plain": plain, "pickled": pickled, "foreign": foreign, "packed": packed}.items():
        refusal(tmp_path, f"{name}.npz", file.getvalue())


def test_an_array_larger_than_memory_is_refused(good, tmp_path):
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000, 64), }".ljust(117) + b"\n"
    table = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header
    file = io.BytesIO(npz_bytes(good))
    with zipfile.ZipFile(file) as whole, zipfile.ZipFile(tmp_path / "large.npz", "w") as archive:
        for entry in whole.namelist():
            archive.writestr(entry, table if entry == "table.npy" else whole.read(entry))
    refusal(tmp_path, "large.npz", (tmp_path / "large.npz").read_bytes())


TABLES = {
    "no rows": lambda run: SavedRun(run.columns, run.table[:0], run.manifest),
    "a column too few": lambda run: SavedRun(run.columns, run.table[:, 1:], run.manifest),
    "one row, no table": lambda run: SavedRun(run.columns, run.table[0], run.manifest),
    "words": lambda run: SavedRun(run.columns, run.table.astype(str), run.manifest),
    "no time": lambda run: SavedRun(("time", *run.columns[1:]), run.table, run.manifest),
    "twice the same column": lambda run: SavedRun((*run.columns[:-1], "time_s"), run.table, run.manifest),
    "time goes back": lambda run: SavedRun(run.columns, run.table[::-1], run.manifest),
    "time is no number": lambda run: SavedRun(run.columns, run.table * np.nan, run.manifest),
    "a posture that is no number": lambda run: _with(run, "angle_", np.nan),
    "an orientation of no length": lambda run: _with(run, "pelvis_q", 0.0),
    "time without end": lambda run: SavedRun(run.columns, run.table * 1e300, run.manifest),
}


def _with(run: SavedRun, start: str, value: float) -> SavedRun:
    changed = run.table.copy()
    changed[3, [i for i, name in enumerate(run.columns) if name.startswith(start)]] = value
    return SavedRun(run.columns, changed, run.manifest)


@pytest.mark.parametrize("what", TABLES)
def test_a_table_that_is_none_is_refused(good, tmp_path, what):
    assert "is no saved run" in refusal(tmp_path, "run.npz", npz_bytes(TABLES[what](good)))


MANIFESTS = {
    "a list": lambda manifest: [1, 2],
    "another format": lambda manifest: {**manifest, "format": "surefoot-run-9"},
    "no robot": lambda manifest: {key: value for key, value in manifest.items() if key != "robot"},
    "a robot of numbers": lambda manifest: {**manifest, "robot": 3},
    "events of another kind": lambda manifest: {**manifest, "events": [[0.1, "push"]]},
    "an event at no time": lambda manifest: {**manifest, "events": [["soon", "push", "a push"]]},
    "an event far too late": lambda manifest: {**manifest, "events": [[1e300, "push", "a push"]]},
    "stones of nothing": lambda manifest: {**manifest, "stones": [{}]},
    "a stone as high as a house": lambda manifest: _stone(manifest, height_m=5.0),
    "a stone of no known shape": lambda manifest: _stone(manifest, shape="cat"),
    "no ground": lambda manifest: {**manifest, "ground": {}},
    "a ground too steep": lambda manifest: _ground(manifest, slope_deg=80.0),
    "terrain of another kind": lambda manifest: {**manifest, "terrain": [1, 2]},
    "a block without a place": lambda manifest: {**manifest, "terrain": {"blocks": [[0.1, 0.2]]}},
    "a block of words": lambda manifest: {**manifest, "terrain": {"blocks": [["a"] * 5]}},
    "a summary of words": lambda manifest: {**manifest, "summary": "fine"},
}


def _stone(manifest, **changes):
    first = manifest["stones"][0]
    return {**manifest, "stones": [{**first, "stone": {**first["stone"], **changes}}]}


def _ground(manifest, **changes):
    ground = manifest["ground"]
    return {**manifest, "ground": {**ground, "ground": {**ground["ground"], **changes}}}


@pytest.mark.parametrize("what", MANIFESTS)
def test_a_manifest_that_makes_no_sense_is_refused(good, tmp_path, what):
    changed = MANIFESTS[what](good.manifest)
    file = io.BytesIO()
    np.savez(file, table=good.table, columns=list(good.columns), manifest=json.dumps(changed))
    assert "is no saved run" in refusal(tmp_path, "run.npz", file.getvalue())


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, '{"format": NaN}', "[]"])
def test_a_manifest_that_is_no_json_is_refused(good, tmp_path, text):
    file = io.BytesIO()
    np.savez(file, table=good.table, columns=list(good.columns), manifest=text)
    assert "is no saved run" in refusal(tmp_path, "run.npz", file.getvalue())


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("commit", ["abc", None])  # None: made by an installed package, not in a checkout
def test_a_good_run_opens(good, tmp_path, suffix, commit):
    file = tmp_path / f"run{suffix}"
    file.write_bytes(SUFFIXES[suffix](SavedRun(good.columns, good.table, {**good.manifest, "git_commit": commit})))
    np.testing.assert_array_equal(open_run(file).table, good.table)
