"""As many digits as a figure's size asks for."""

import pytest

from surefoot.number_text import figure


@pytest.mark.parametrize(
    ("value", "text"),
    [(4.13, "4.1"), (4.0, "4"), (19.96, "20"), (20.4, "20"), (187.3, "187"), (-3.26, "-3.3"), (-0.04, "0"), (0.0, "0")],
)
def test_small_figures_have_a_decimal_and_large_ones_none(value, text):
    assert figure(value) == text
