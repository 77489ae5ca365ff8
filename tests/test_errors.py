"""The errors for users: one line whatever the text, and the same in another process."""

import pickle

import pytest

from surefoot.errors import ControllerError, InvalidInput, LibraryError, PostureError, one_line


@pytest.mark.parametrize(
    "error",
    [
        InvalidInput("speed", 3, "is too much", [1, 2]),
        ControllerError("guest", "cannot be built"),
        PostureError("out of reach", 0.1),
        LibraryError("Pinocchio", "not there"),
    ],
    ids=lambda error: type(error).__name__,
)
def test_an_error_is_the_same_in_another_process(error):
    there = pickle.loads(pickle.dumps(error))
    assert (type(there), str(there), vars(there)) == (type(error), str(error), vars(error))


class SpeechlessError(Exception):
    def __str__(self):
        raise RuntimeError("no words")


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (ValueError(), "ValueError"),
        (ValueError("two\n  lines\tof it\n"), "ValueError: two lines of it"),
        (ValueError("x" * 5000), f"ValueError: {'x' * 240} ..."),
        (SpeechlessError(), "SpeechlessError: its own text cannot be made"),
    ],
)
def test_an_error_of_other_code_is_told_in_a_line(error, line):
    assert one_line(error) == line
