"""Figures with as many digits as their size asks for: 4.2 N s, but 20 N s."""

_WHOLE_FROM = 20.0


def figure(value: float) -> str:
    """A number to one decimal, to none where it is 20 or more; never a decimal that is zero."""
    return f"{round(value, 0 if abs(value) >= _WHOLE_FROM else 1) + 0.0:g}"  # -0.0 + 0.0 is 0.0
