"""As many digits as a figure's size asks for, and no minus before a zero."""

import pytest

from surefoot.number_text import decimals_for, figure, fixed


@pytest.mark.parametrize(
    ("value", "text"),
    [(4.13, "4.1"), (4.0, "4"), (19.96, "20"), (20.4, "20"), (187.3, "187"), (-3.26, "-3.3"), (-0.04, "0"), (0.0, "0")],
)
def test_small_figures_have_a_decimal_and_large_ones_none(value, text):
    assert figure(value) == text


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [(-0.04, 1, "0.0"), (-0.06, 1, "-0.1"), (-0.4, 0, "0"), (0.0, 2, "0.00"), (2.345, 0, "2"), (187.25, 1, "187.2")],
)
def test_what_rounds_to_zero_has_no_sign(value, decimals, text):
    assert fixed(value, decimals) == text


@pytest.mark.parametrize(("ratio", "decimals"), [(1.0, 0), (0.6, 0), (0.27, 1), (0.05, 1), (0.0117, 2), (3.0, 0)])
def test_a_small_robot_s_figures_have_as_many_digits_as_bips(ratio, decimals):
    assert decimals_for(ratio) == decimals
