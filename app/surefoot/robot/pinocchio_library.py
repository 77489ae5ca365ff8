"""Pinocchio, made sure to be it: another package of that name, on ``PYTHONPATH`` say, is named in one line."""

from surefoot.errors import LibraryError

_NAME = "Pinocchio (the Python package pin)"
_USED = ("buildModelFromMJCF", "computeAllTerms", "SE3")

try:
    import pinocchio as pin
except ImportError as error:
    raise LibraryError(_NAME, f"{error} (found first: {getattr(error, 'path', None) or 'nothing'})") from error
if not all(hasattr(pin, name) for name in _USED):
    raise LibraryError(_NAME, f"another package is found first, {pin.__file__}; see PYTHONPATH and the working folder")

__all__ = ["pin"]
