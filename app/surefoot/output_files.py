"""Files that people ask for: refused before the work where they cannot be written, and written whole or not at all."""

import itertools
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from surefoot.errors import InvalidInput

OUT = "--out"


def check_kind(out: Path, kinds: Iterable[str]) -> None:
    """Raises InvalidInput for a file of ``--out`` whose suffix is none of ``kinds``."""
    if out.suffix not in kinds:
        raise InvalidInput(OUT, str(out), "unknown kind of file", kinds)


def check_writable(out: Path, flag: str = OUT) -> None:
    """Refuse a file that could not be written later, by trying. Raises InvalidInput.

    Args:
        out: the file; what it holds stays.
        flag: what it was asked for with.
    """
    if not out.parent.is_dir():
        raise InvalidInput(flag, str(out), "its folder does not exist")
    if out.is_dir():
        raise InvalidInput(flag, str(out), "is a folder")
    if out.exists() and not os.access(out, os.W_OK):
        raise InvalidInput(flag, str(out), "cannot be written: it is read-only")
    if not _is_device(out):
        with writing(out, flag):
            _try(_place(out).parent)


def check_folder(out: Path, flag: str = OUT) -> None:
    """Make a folder, and refuse one that nothing can be written into. Raises InvalidInput."""
    with writing(out, flag):
        out.mkdir(parents=True, exist_ok=True)
        _try(out)


@contextmanager
def writing(out: Path, flag: str = OUT) -> Iterator[None]:
    """What the system refuses inside is the person's to know. Raises InvalidInput."""
    try:
        yield
    except OSError as error:
        raise InvalidInput(flag, str(out), f"cannot be written: {error.strerror or error}") from None


def write_file(out: Path, content: bytes | str) -> None:
    """Write a file in one piece, see ``whole_file``. Raises OSError."""
    with whole_file(out) as stream:
        stream.write(content.encode() if isinstance(content, str) else content)


@contextmanager
def whole_file(out: Path) -> Iterator[BinaryIO]:
    """A stream that becomes the file once it is whole: a full disk or a killed process leaves what was there before.

    A device or a pipe (``/dev/stdout``) is written into; everything else is replaced. Raises OSError.
    """
    if _is_device(out):
        with tempfile.TemporaryFile() as stream:
            yield stream
            stream.seek(0)
            with out.open("wb") as device:
                shutil.copyfileobj(stream, device)
        return
    whole = _place(out)
    part = whole.with_name(f"{whole.name}.{os.getpid()}.part")
    try:
        with part.open("wb") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        if whole.exists():
            part.chmod(whole.stat().st_mode)
        os.replace(part, whole)
    finally:
        part.unlink(missing_ok=True)


def numbered_beside(out: Path, suffix: str) -> Iterator[Path]:
    """Names for a file that helps to make ``out``, in its folder: NAME.suffix, NAME.2.suffix, ... without end.

    What helps to write into a device or a pipe lies in the folder for temporary files.
    """
    whole = Path(tempfile.gettempdir()) / out.name if _is_device(out) else _place(out)
    for number in itertools.count(1):
        yield whole.with_name(f"{whole.name}{suffix}" if number == 1 else f"{whole.name}.{number}{suffix}")


def _place(out: Path) -> Path:
    """Where the file itself is: a link stays a link."""
    return out.resolve() if out.is_symlink() else out


def _is_device(out: Path) -> bool:
    return out.exists() and not out.is_file()


def _try(folder: Path) -> None:
    with tempfile.NamedTemporaryFile(dir=folder, prefix=".surefoot-"):
        pass
