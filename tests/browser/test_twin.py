"""Twin run as a person does it: start it, drop one stone under both, see where they part and which one falls."""

import numpy as np
import pytest

pytestmark = pytest.mark.browser


def violet(pixels: np.ndarray) -> int:
    """Pixels tinted by the twin: more blue and red than green, which belongs to nothing else in the scene."""
    red, green, blue = np.moveaxis(pixels, 2, 0)
    return int(((blue - green > 25) & (red - green > 10)).sum())


def test_one_stone_two_controllers(screen):
    session, page = screen.dashboard.session, screen.page
    screen.tab("Twin")
    page.get_by_text("no twin run").wait_for()
    screen.press("Start twin run")
    page.get_by_text("no divergence yet").wait_for()
    screen.wait_for(lambda: violet(screen.pixels()) > 500)

    screen.press("outer edge")
    page.get_by_text("first divergence").wait_for()
    strip = page.get_by_label("Twin run", exact=True)
    strip.get_by_text("FALL at").wait_for()
    screen.keep("twin_ghost")
    said = strip.inner_text()
    assert "after: stone 10 mm high" in said
    assert "first · two-part: stands" in said
    assert "twin · optimization: FALL at" in said
    twin = session.snapshot.twin
    assert twin.other.balance.fall_cause == "support_lost"
    assert session.snapshot.balance.fall_cause is None
    assert page.get_by_text("Bip has fallen").is_hidden()

    screen.choose("Twin shown as", "side by side")
    screen.wait_for(lambda: violet(screen.pixels()) > 500)
    screen.keep("twin_side_by_side")

    screen.press("Stop twin run")
    page.get_by_text("no twin run").wait_for()
    screen.wait_for(lambda: session.snapshot.twin is None)
