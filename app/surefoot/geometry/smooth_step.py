"""A step without a kink."""


def smooth_step(x: float) -> float:
    """0 below 0, 1 above 1, and 3 x^2 - 2 x^3 between, whose slope is 0 at both ends."""
    if x <= 0.0:
        return 0.0
    if x >= 1.0:
        return 1.0
    return x * x * (3.0 - 2.0 * x)
