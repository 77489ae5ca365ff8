"""The errors a user can cause, each carrying the data that explains it and the choices that would have worked."""

from collections.abc import Iterable


class SurefootError(Exception):
    """Base of every error meant for the user; its text is one clear line."""


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
        super().__init__(f"{field} = {value!r}: {reason}{choices}")


class PostureError(SurefootError):
    """No joint angles realise the posture asked for.

    Args:
        reason: what could not be reached.
        residual: remaining task error, metres and radians mixed.
    """

    def __init__(self, reason: str, residual: float):
        self.residual = residual
        super().__init__(f"posture: {reason} (remaining error {residual:.3g}; try com_height_m from 0.97 to 0.985)")


class LibraryError(SurefootError):
    """A library that Surefoot needs is not there, or another package of its name is found before it.

    Args:
        library: what is needed, e.g. ``Pinocchio (pip install pin)``.
        reason: what was found instead.
    """

    def __init__(self, library: str, reason: str):
        super().__init__(f"{library} cannot be used: {reason}")
