"""The same table to the bit, wherever it was computed."""

import subprocess
import sys

import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.store import TABLE


def table_of(tiny, folder, **where) -> bytes:
    tiny.run_bench(tiny.tiny_bench(), folder, **where)
    return (folder / TABLE).read_bytes()


def test_two_workers_give_the_table_of_one(tiny, finished_tiny, tmp_path):
    assert table_of(tiny, tmp_path, workers=2) == (finished_tiny / TABLE).read_bytes()


def test_a_dask_cluster_of_two_workers_gives_the_same_table(tiny, finished_tiny, tmp_path):
    pytest.importorskip("distributed")
    assert table_of(tiny, tmp_path, workers=2, cluster="local") == (finished_tiny / TABLE).read_bytes()


def test_an_address_where_no_scheduler_answers_is_refused(tiny, tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("surefoot.experiments.bench.engine._CONNECT_S", 0.5)
    with pytest.raises(InvalidInput, match="no Dask scheduler answers there"):
        table_of(tiny, tmp_path, cluster="tcp://127.0.0.1:9")


def test_without_dask_the_cluster_says_what_to_install(tiny, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InvalidInput, match=r"pip install 'surefoot\[cluster\]'"):
        table_of(tiny, tmp_path, cluster="tcp://127.0.0.1:9")


def test_dask_is_not_imported_unless_asked_for():
    code = "import sys, surefoot.experiments.bench.bench; sys.exit('distributed' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
