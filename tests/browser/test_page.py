"""What a person sees and does, in a real browser."""

import numpy as np
import pytest

from surefoot.dashboard.page import FRAME_S

pytestmark = pytest.mark.browser

STONE_AT = (0.05, 0.18, 0.0)  # outer edge of the left sole, world


@pytest.fixture
def frame_s():
    """The page's own rate."""
    return FRAME_S


def shows_bip(pixels: np.ndarray) -> bool:
    """Orange strips of the trunk and dark motors: neither belongs to ground, sky or a blank page."""
    red, green, blue = np.moveaxis(pixels, 2, 0)
    orange = (red > 170) & (red - blue > 80) & (green > 80) & (green < 190)
    dark = (red < 90) & (green < 90) & (blue < 95)
    return bool(orange.sum() > 100 and dark.sum() > 100)


def test_bip_is_seen_and_can_be_poked(screen):
    screen.wait_for(lambda: shows_bip(screen.pixels()))
    screen.keep("page_standing")

    screen.choose("Controller", "soft-qp")
    screen.see_event("controller two-part -> soft-qp")
    screen.choose("Controller", "two-part")
    screen.see_event("controller soft-qp -> two-part")

    screen.tab("Gains")
    screen.set_number("CoM K_P", 75)
    screen.see_event("com_stiffness = 75")
    screen.wait_for(lambda: screen.dashboard.session.snapshot.settings.com_stiffness == 75.0)

    screen.tab("Disturb")
    screen.set_number("Stone height", 8)
    x, y = screen.where(STONE_AT)
    screen.page.keyboard.down("Control")
    screen.page.mouse.click(x, y)
    screen.page.keyboard.up("Control")
    screen.see_event("stone 8 mm high")
    screen.see_event("rises under the left sole")
    screen.wait_for(lambda: len(screen.dashboard.session.snapshot.geometry.stones) == 1)
    stone = screen.dashboard.session.snapshot.geometry.stones[0]
    assert stone.position[:2] == pytest.approx(STONE_AT[:2], abs=0.03)
    screen.keep("page_stone")


def test_optimization_falls_on_a_stone_where_two_part_stands(screen):
    session = screen.dashboard.session
    screen.press("outer edge")
    screen.see_event("stone 10 mm high")
    placed = session.snapshot.time_s
    screen.wait_for(lambda: session.snapshot.time_s > placed + 4.0)
    assert session.snapshot.balance.fall_cause is None
    screen.keep("two_part_stands")

    screen.press("Reset")
    screen.see_event("reset: scenario stand_left")
    screen.choose("Controller", "optimization")
    screen.see_event("controller two-part -> optimization")
    screen.press("outer edge")
    screen.see_event("by support_lost: the swing foot carries more than 50 N")
    screen.page.get_by_text("Bip has fallen").wait_for()
    screen.see_event("paused after the fall")
    screen.keep("optimization_falls")

    run = session.snapshot.run
    screen.press("Reset and try again")
    screen.wait_for(lambda: session.snapshot.run == run + 1)
    screen.page.get_by_text("Bip has fallen").wait_for(state="hidden")
    assert session.snapshot.controller == "optimization"


def test_keys_work(screen):
    session = screen.dashboard.session
    screen.wait_for(lambda: shows_bip(screen.pixels()))
    box = screen.canvas_box()
    screen.page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.1 * box["height"])
    screen.page.keyboard.press("2")
    screen.see_event("controller two-part -> optimization")
    screen.page.keyboard.press("Space")
    screen.wait_for(lambda: not session.snapshot.playing)
    screen.page.keyboard.press("r")
    screen.see_event("reset: scenario stand_left, controller optimization")
    screen.wait_for(lambda: session.snapshot.playing)
