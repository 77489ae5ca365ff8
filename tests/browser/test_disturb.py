"""What a person does to Bip with the mouse, and what a newcomer is shown, in a real browser."""

import numpy as np
import pytest

from surefoot.dashboard.messages.commands import Play
from tests.support.waiting import wait_for

pytestmark = pytest.mark.browser

FREE = (0.45, 0.35, 0.0)
OUTER_EDGE = (0.05, 0.18, 0.0)
TRUNK = (0.1, 0.1, 1.25)
PATIENCE_MS = 120_000
PREVIEW_ORANGE = 60  # red and green well above blue


def click(screen, point, *keys) -> None:
    for key in keys:
        screen.page.keyboard.down(key)
    screen.page.mouse.click(*screen.where(point))
    for key in reversed(keys):
        screen.page.keyboard.up(key)


def take_hold(screen, x: float, y: float) -> None:
    """Hold shift over a link, press and draw a little; once more if the page was not ready for it."""
    mouse, geometry = screen.page.mouse, lambda: screen.dashboard.session.snapshot.geometry
    screen.page.keyboard.down("Shift")

    def held() -> bool:
        mouse.up()
        mouse.move(x, y)
        mouse.down()
        mouse.move(x + 6, y)
        mouse.move(x + 12, y)
        for _ in range(PATIENCE_MS // 4000):
            if len(geometry().pulls) == 1:
                return True
            screen.page.wait_for_timeout(200)
        return False

    screen.wait_for(held)


def stretch(session) -> float:
    """How far the hand is from the point that it pulls [m]."""
    point, hand, _ = session.snapshot.geometry.pulls[0].reshape(3, 3)
    return float(np.linalg.norm(hand - point))


def yellow_near(screen, point) -> int:
    """Yellow pixels around a world point: the preview, and nothing else on the ground."""
    x, y = screen.where(point)
    shot = screen.shot({"x": x - 20, "y": y - 15, "width": 40, "height": 30})
    red, green, blue = np.moveaxis(shot, 2, 0)
    return int(((red - blue > PREVIEW_ORANGE) & (green - blue > PREVIEW_ORANGE // 2)).sum())


def test_stones_are_shown_placed_shaped_dragged_and_removed(screen):
    session = screen.dashboard.session
    screen.wait_for(lambda: session.snapshot.time_s > 0.1)
    screen.wait_for(lambda: yellow_near(screen, FREE) == 0)
    click(screen, FREE, "Control", "Shift")
    screen.wait_for(lambda: yellow_near(screen, FREE) > 30)
    assert session.snapshot.geometry.stones == ()  # only shown
    screen.keep("stone_preview")

    screen.page.get_by_text("See it first", exact=True).click()
    screen.press("Place it there")
    screen.see_event("stone 10 mm high")
    screen.wait_for(lambda: len(session.snapshot.geometry.stones) == 1)
    screen.wait_for(lambda: yellow_near(screen, FREE) == 0)  # the real one has taken its place

    screen.choose("Stone shape", "wedge")
    click(screen, OUTER_EDGE, "Control")
    screen.see_event("wedge 10 mm high")
    screen.see_event("rises under the left sole")
    screen.wait_for(lambda: len(session.snapshot.geometry.stones) == 2)

    x, y = screen.where(session.snapshot.geometry.stones[0].position)
    screen.page.mouse.move(x, y)
    screen.page.mouse.down()
    for i in range(1, 9):
        screen.page.mouse.move(x + 5 * i, y + 4 * i)
    screen.page.mouse.up()
    screen.see_event("stone 1 moved to")
    place = session.snapshot.geometry.stones[0].stone
    assert np.hypot(place.x_m - FREE[0], place.y_m - FREE[1]) > 0.04
    screen.keep("stone_wedge_and_dragged")

    screen.page.get_by_text("Stones on the ground", exact=True).click()
    screen.press("all")
    screen.see_event("all stones removed")


def test_a_link_is_pulled_while_shift_is_held_and_the_mouse_is_down(screen):
    session = screen.dashboard.session
    screen.wait_for(lambda: session.snapshot.time_s > 0.1)
    x, y = screen.where(TRUNK)
    take_hold(screen, x, y)
    for i in range(3, 9):
        screen.page.mouse.move(x + 4 * i, y)
    screen.see_event("pull at trunk")
    screen.wait_for(lambda: stretch(session) > 0.02)
    point, hand, force = session.snapshot.geometry.pulls[0].reshape(3, 3)
    assert force.dot(hand - point) > 0.0
    screen.keep("pull")
    screen.page.mouse.up()
    screen.page.keyboard.up("Shift")
    screen.see_event("let go of trunk")
    assert len(session.snapshot.geometry.pulls) == 0

    take_hold(screen, x, y)
    screen.page.close()  # a hand that leaves lets go
    wait_for(lambda: len(session.snapshot.geometry.pulls) == 0)


def test_the_tour_shows_a_newcomer_the_papers_result_and_can_be_dismissed(newcomer):
    session, page = newcomer.dashboard.session, newcomer.page
    words = ("It recovers.", "stands just as well", "Bip has fallen.", "Ready.", "It holds.", "It walks.")
    for number, said in enumerate(words, 1):
        page.get_by_text(f"{number}/{len(words)}").wait_for()
        newcomer.press("Do it for me")
        page.get_by_text("✓").filter(has_text=said).first.wait_for()
        if said == "Bip has fallen.":
            assert session.snapshot.controller == "optimization"
            assert session.snapshot.balance.fall_cause is not None
        newcomer.keep(f"tour_{number}")
        newcomer.press("Next")
    assert session.snapshot.controller == "two-part"
    assert session.snapshot.balance.fall_cause is None
    page.get_by_text("Do it for me").wait_for(state="hidden")
    newcomer.open()
    newcomer.wait_for(lambda: len(newcomer.dashboard.server.get_clients()) == 1)
    newcomer.tab("Help")
    assert page.get_by_text("Do it for me").count() == 0
    newcomer.press("Start the tour")
    page.get_by_text("1/6").wait_for()


def test_a_number_is_taken_as_typed_when_it_is_finished(screen):
    page, sliders = screen.page, screen.dashboard.server.gui._gui_input_handle_from_uuid.values()
    impulse = next(slider for slider in sliders if getattr(slider, "label", "").startswith("Impulse"))
    seen = []
    impulse.on_update(lambda _: seen.append(impulse.value))
    box = screen.number_box("Impulse")

    def typed(text, key):
        box.press("Control+a")
        box.press_sequentially(text)
        box.press(key)

    typed("12,5", "Enter")
    screen.wait_for(lambda: impulse.value == 12.5)
    typed("33.25", "Tab")
    screen.wait_for(lambda: impulse.value == 33.25)
    assert seen == [12.5, 33.25]  # not 1, 12, 3, ...
    assert box.input_value() == "33.25"
    for text, value in (("12.0", 12.0), ("12.50", 12.5), ("2e1", 20.0), ("33.250", 33.25)):
        typed(text, "Enter")  # the client would pass on a text for these, or leave the "e" out
        screen.wait_for(lambda value=value: impulse.value == value)
    del seen[2:]

    typed("500", "Enter")
    page.get_by_role("alert").get_by_text("500: out of range (1 to 100)").wait_for()
    screen.keep("number_refused")
    assert box.input_value() == "33.25"
    typed("1-2", "Enter")
    page.get_by_role("alert").get_by_text("is no number").wait_for()
    typed("7", "Escape")
    assert box.input_value() == "33.25"
    assert seen == [12.5, 33.25]

    screen.tab("Gains")
    box = screen.number_box("CoM K_P")
    typed("120", "Enter")
    screen.see_event("com_stiffness = 120")
    session = screen.dashboard.session
    steps = [event.text for event in session.snapshot.events if "com_stiffness" in event.text]
    assert len(steps) == 1

    box = screen.number_box("t [s]")
    back = round(float(box.input_value()) - 0.1, 2)  # what the page shows: a busy one may be further behind the run
    typed(f"{back}", "Enter")
    screen.wait_for(lambda: not session.snapshot.playing and session.snapshot.time_s == pytest.approx(back))
    session.send(Play())
    screen.wait_for(lambda: float(box.input_value()) > back + 0.2)  # still in focus, it follows the run again

    box.press("Control+a")  # and waits for the person who wants to type, be it for a while
    seen_s, shown = session.snapshot.time_s, box.input_value()
    for typed_before, key in enumerate(f"{back}"):
        screen.wait_for(lambda later_s=seen_s + 0.3: session.snapshot.time_s > later_s)
        seen_s = session.snapshot.time_s
        assert box.input_value() == (f"{back}"[:typed_before] or shown)
        box.press(key)
    box.press("Enter")
    screen.wait_for(lambda: not session.snapshot.playing and session.snapshot.time_s == pytest.approx(back))
