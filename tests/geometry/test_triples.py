"""Vectors of three plain numbers, against NumPy."""

import numpy as np
import pytest

from surefoot.geometry.triples import blend, combine, cross_product

A, B = (0.3, -1.2, 2.5), [-0.7, 0.4, 1.1]


def test_sums_in_any_shares():
    assert combine(0.25, A, -3.0, B) == pytest.approx(0.25 * np.array(A) - 3.0 * np.array(B), rel=1e-15)


@pytest.mark.parametrize("share", [0.0, 0.2, 1.0])
def test_a_blend_goes_from_one_to_the_other(share):
    assert blend(A, B, share) == pytest.approx((1.0 - share) * np.array(A) + share * np.array(B), rel=1e-14)


def test_the_vector_product_has_numpys_value_and_sign():
    assert cross_product(A, B) == pytest.approx(np.cross(A, B), rel=1e-14)
