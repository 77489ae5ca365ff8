"""A file that was asked for: refused before the work, whole afterwards, and what was there before is not lost."""

import errno
import os
from pathlib import Path

import pytest

from surefoot.errors import InvalidInput
from surefoot.output_files import check_folder, check_kind, check_writable, write_file, writing

NOWHERE = Path("/proc")  # nobody can make a file there, not even root


def test_a_file_that_can_be_written_is_left_as_it_is(tmp_path):
    file = tmp_path / "run.json"
    check_writable(file)
    assert not any(tmp_path.iterdir())
    file.write_text("before")
    check_writable(file)
    assert file.read_text() == "before"
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize("place", ["no_such_folder/run.json", "folder"])
def test_a_wrong_place_is_refused(tmp_path, place):
    (tmp_path / "folder").mkdir()
    with pytest.raises(InvalidInput, match="folder"):
        check_writable(tmp_path / place, "--to")


@pytest.mark.skipif(not NOWHERE.is_dir(), reason="no /proc here")
def test_a_folder_that_takes_no_files_is_refused():
    with pytest.raises(InvalidInput, match=r"--out.*cannot be written"):
        check_writable(NOWHERE / "run.json")
    for folder in (NOWHERE, NOWHERE / "new"):
        with pytest.raises(InvalidInput, match=r"--out.*cannot be written"):
            check_folder(folder)


def test_a_read_only_file_is_refused(tmp_path, monkeypatch):
    file = tmp_path / "run.json"
    file.write_text("precious")
    monkeypatch.setattr(os, "access", lambda path, mode: False)  # root may write everything
    with pytest.raises(InvalidInput, match="read-only"):
        check_writable(file)


def test_an_unknown_kind_lists_the_known_ones():
    with pytest.raises(InvalidInput, match=r"\.csv, \.json"):
        check_kind(Path("run.xls"), [".csv", ".json"])


def test_a_folder_is_made(tmp_path):
    check_folder(tmp_path / "a" / "b")
    assert not any((tmp_path / "a" / "b").iterdir())


@pytest.mark.parametrize("content", ["text \N{GREEK SMALL LETTER DELTA}\n", b"\x00\x01"])
def test_a_file_is_replaced_in_one_piece(tmp_path, content):
    file = tmp_path / "run.json"
    file.write_text("before")
    file.chmod(0o640)
    write_file(file, content)
    assert file.read_bytes() == (content if isinstance(content, bytes) else content.encode())
    assert file.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [file]


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "real").mkdir()
    link, real = tmp_path / "run.json", tmp_path / "real" / "run.json"
    link.symlink_to(real)
    check_writable(link)
    write_file(link, "new")
    assert link.is_symlink()
    assert real.read_text() == "new"


def test_a_full_disk_leaves_what_was_there(tmp_path, monkeypatch):
    def full(descriptor):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    file = tmp_path / "run.json"
    file.write_text("before")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(InvalidInput, match="No space left on device"), writing(file):
        write_file(file, "after")
    assert file.read_text() == "before"
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_a_device_is_written_into_and_stays(tmp_path):
    check_writable(Path("/dev/full"))
    with pytest.raises(InvalidInput, match="No space left on device"), writing(Path("/dev/full")):
        write_file(Path("/dev/full"), "much")
    assert Path("/dev/full").is_char_device()
    assert not list(Path("/dev").glob("*.part"))
