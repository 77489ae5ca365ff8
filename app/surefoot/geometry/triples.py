"""Vectors of three plain numbers: for a sum or two, Python is faster with them than with arrays of three."""

from collections.abc import Sequence

Triple = tuple[float, float, float]


def combine(share_a: float, a: Sequence[float], share_b: float, b: Sequence[float]) -> Triple:
    """``share_a`` a + ``share_b`` b."""
    (ax, ay, az), (bx, by, bz) = a, b
    return share_a * ax + share_b * bx, share_a * ay + share_b * by, share_a * az + share_b * bz


def blend(a: Sequence[float], b: Sequence[float], share: float) -> Triple:
    """From a so much of the way to b."""
    (ax, ay, az), (bx, by, bz) = a, b
    return ax + share * (bx - ax), ay + share * (by - ay), az + share * (bz - az)


def cross_product(a: Sequence[float], b: Sequence[float]) -> Triple:
    """``a x b``."""
    (ax, ay, az), (bx, by, bz) = a, b
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
