"""The errors a user can cause, each carrying the data that explains it and the choices that would have worked."""

from collections.abc import Iterable, Mapping
from typing import Any

_LONGEST_REASON = 240


class SurefootError(Exception):
    """Base of every error meant for the user; its text is one clear line. It can be sent to another process."""

    def __reduce__(self) -> tuple[Any, ...]:
        """How it is sent."""
        return _received, (type(self), self.args, vars(self))


def _received(kind: type[SurefootError], args: tuple[Any, ...], attributes: Mapping[str, Any]) -> SurefootError:
    """The error as it was sent: its text is known, so it is not made again from what its class takes."""
    error = kind.__new__(kind, *args)
    vars(error).update(attributes)
    return error


def one_line(error: BaseException) -> str:
    """Kind and text of an error of code from outside, whose text may have many lines, or fail itself."""
    try:
        text = " ".join(str(error).split())
    except Exception:
        text = "its own text cannot be made"
    return f"{type(error).__name__}: {_shortened(text)}" if text else type(error).__name__


def _shortened(text: str) -> str:
    return f"{text[:_LONGEST_REASON]} ..." if len(text) > _LONGEST_REASON else text


def _shown(value: object) -> str:
    """A value as Python writes it, if it can be written: one nested too deeply, or of too many digits, cannot."""
    try:
        return _shortened(repr(value))
    except (RecursionError, ValueError):
        return f"({type(value).__name__} that cannot be shown)"


class InvalidInput(SurefootError):
    """A value from outside (file, flag, slider, message) that cannot be used.

    Args:
        field: where the value stands, e.g. ``stones.0.height_m``.
        value: the value that was given.
        reason: what is wrong with it, one clause.
        valid: the choices that would have been accepted, if they can be listed.
    """

    def __init__(self, field: str, value: object, reason: str, valid: Iterable[object] = ()):
        self.field, self.value, self.reason = field, value, reason
        self.valid = [str(choice) for choice in valid]
        choices = f" (valid: {', '.join(self.valid)})" if self.valid else ""
        where = field if field.isprintable() else repr(field)[1:-1]  # a key of a file may hold a line's end
        super().__init__(f"{_shortened(where)} = {_shown(value)}: {reason}{choices}")


class ControllerError(SurefootError):
    """A controller from outside failed where nothing has happened yet: it was being built, or handed the robot.

    Args:
        controller: its name.
        reason: what it did, one clause.
    """

    def __init__(self, controller: str, reason: str):
        super().__init__(f"controller {controller}: {reason}")


class EstimatorError(SurefootError):
    """An estimator failed, or gave what is no number.

    Args:
        estimator: its name.
        reason: what it did, one clause.
    """

    def __init__(self, estimator: str, reason: str):
        super().__init__(f"estimator {estimator}: {reason}")


class PostureError(SurefootError):
    """No joint angles realise the posture asked for.

    Args:
        reason: what could not be reached.
        residual: remaining task error, metres and radians mixed.
        hint: what could be asked for instead.
    """

    def __init__(self, reason: str, residual: float, hint: str = ""):
        self.reason, self.residual = reason, residual
        super().__init__(f"posture: {reason} (remaining error {residual:.3g}{f'; {hint}' if hint else ''})")


class LibraryError(SurefootError):
    """A library that Surefoot needs is not there, or another package of its name is found before it.

    Args:
        library: what is needed, e.g. ``Pinocchio (pip install pin)``.
        reason: what was found instead.
    """

    def __init__(self, library: str, reason: str):
        super().__init__(f"{library} cannot be used: {reason}")
