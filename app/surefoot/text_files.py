"""Text files that people give the program, as any editor and system writes them: the one place that reads them.

UTF-8, with or without a byte-order mark, lines ended in any way. What else a file may be is said in one line.
"""

import codecs
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput

LARGEST_BYTES = 1_000_000  # a scenario has about a thousand
# How a file begins that was saved in another encoding; UTF-32 before UTF-16, whose mark begins its own
_OTHER_ENCODINGS = (
    (codecs.BOM_UTF32_LE, "UTF-32"),
    (codecs.BOM_UTF32_BE, "UTF-32"),
    (codecs.BOM_UTF16_LE, "UTF-16"),
    (codecs.BOM_UTF16_BE, "UTF-16"),
)


def file_content(path: Path, field: str, *, valid: Iterable[object] = ()) -> bytes:
    """The bytes of a file, read no further than just beyond ``LARGEST_BYTES``.

    Args:
        path: of the file.
        field: what the file is, in an error.
        valid: what could have been given instead of a file that is not there.

    Raises:
        InvalidInput: it is not there, or cannot be read.
    """
    try:
        with path.open("rb") as file:
            return file.read(LARGEST_BYTES + 1)
    except FileNotFoundError as error:
        raise InvalidInput(field, str(path), f"cannot be read: {error.strerror}", valid) from None
    except (OSError, ValueError) as error:  # ValueError: a name that no file can have
        raise InvalidInput(field, str(path), f"cannot be read: {getattr(error, 'strerror', error)}") from None


def text_of(content: bytes, field: str, value: object, *, largest: int = LARGEST_BYTES) -> str:
    """The text of a file, every line ended by a line feed alone.

    Args:
        content: its bytes.
        field: what the file is, in an error.
        value: which one it is, in an error.
        largest: how many bytes it may have.

    Raises:
        InvalidInput: too large, or not UTF-8; says what it seems to be instead.
    """
    if len(content) > largest:
        raise InvalidInput(field, value, "is too large", [f"up to {largest} bytes"])
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        seems = _encoding(content) or f"byte 0x{content[error.start]:02x} in line {line}; an older encoding?"
    else:
        if "\0" not in text:
            return text.replace("\r\n", "\n").replace("\r", "\n")
        seems = _encoding(content) or "it has zero bytes; UTF-16, or no text at all?"
    raise InvalidInput(field, value, f"is not UTF-8 text ({seems}): save it as UTF-8")


def toml_of(text: str, field: str, value: object, *, valid: Iterable[object] = ()) -> dict[str, Any]:
    """The tables of a TOML text.

    Args:
        text: of the file.
        field: what the file is, in an error.
        value: which one it is, in an error.
        valid: what it might say.

    Raises:
        InvalidInput: it is not TOML, says a number of thousands of digits, or is nested too deeply to be read.
    """
    try:
        return tomllib.loads(text)
    except RecursionError:
        reason = "it is nested too deeply"
    except tomllib.TOMLDecodeError as error:
        reason = " ".join(str(error).split())
    except ValueError:  # Python refuses to read it
        reason = "a number has too many digits"
    raise InvalidInput(field, value, f"is not valid TOML: {reason}", valid)


def _encoding(content: bytes) -> str | None:
    """What the byte-order mark of another encoding says."""
    name = next((name for mark, name in _OTHER_ENCODINGS if content.startswith(mark)), None)
    return name and f"{name} with a byte-order mark?"
