"""Numbers for people, with as many digits as their size asks for: 4.2 N s, but 20 N s; never "-0.0"."""

import math

_WHOLE_FROM = 20.0
_SMALL = 0.5  # below this share of Bip's, figures get decimals


def fixed(value: float, decimals: int) -> str:
    """A number with so many decimals; what rounds to zero has no sign."""
    return f"{round(value, decimals) + 0.0:.{decimals}f}"  # -0.0 + 0.0 is 0.0


def decimals_for(ratio: float) -> int:
    """Decimals of figures that are whole numbers for Bip, for a robot whose figures are that share of Bip's."""
    return max(0, math.ceil(math.log10(_SMALL / ratio)))


def figure(value: float) -> str:
    """A number to one decimal, to none where it is 20 or more; never a decimal that is zero."""
    return f"{round(value, 0 if abs(value) >= _WHOLE_FROM else 1) + 0.0:g}"
