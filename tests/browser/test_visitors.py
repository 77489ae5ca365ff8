"""Several people in front of one robot: the token, who drives, and one who leaves."""

import pytest

pytestmark = pytest.mark.browser


def open_with_form(screen, address, token):
    page = screen.page
    page.goto(address)
    page.get_by_label("Token").fill("not-the-token-at-all")
    page.keyboard.press("Enter")
    page.get_by_role("alert").wait_for()
    screen.keep("token_form")
    page.get_by_label("Token").fill(token)
    page.get_by_role("button", name="Open the dashboard").click()
    screen.settle()
    assert page.url == address


def stone_height(screen) -> str:
    row = screen.page.locator("label:visible", has_text="Stone height").first
    return row.locator("xpath=ancestor::*[.//input[@type='text']][1]").locator("input[type=text]").first.input_value()


def test_two_visitors_share_a_robot_and_one_leaves(visitors):
    ann, ben = visitors
    session, driver = ann.dashboard.session, ann.dashboard.page.driver_lock.view
    address, _, token = ann.dashboard.address.partition("?token=")
    open_with_form(ann, address, token)
    ann.page.get_by_text("1 visitor: you").wait_for()
    ben.open()
    assert token not in ben.page.url
    ben.page.get_by_text("2 visitors, you are 2: everybody drives").wait_for()
    ben.set_number("Stone height", 12)
    ann.wait_for(lambda: stone_height(ann) == "12")  # one robot, one page

    ann.page.get_by_text("2 visitors, you are 1: everybody drives").click()
    ann.choose("Who drives", "one at a time")
    ben.page.get_by_text("2 visitors, you are 2: visitor 1 drives").wait_for()
    run = session.snapshot.run
    ben.press("Reset")
    ben.page.get_by_text("Ask for control to do that yourself").wait_for()
    ben.set_number("Stone height", 33)
    ben.wait_for(lambda: stone_height(ben) == "12")
    ben.choose("Controller", "soft-qp")
    ben.wait_for(lambda: ben.page.get_by_label("Controller", exact=True).input_value() == "two-part")
    box = ben.canvas_box()
    ben.page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.9 * box["height"])
    ben.page.keyboard.press("2")
    ann.press("+1 ms")  # what was sent before it has been obeyed or refused by then
    ann.wait_for(lambda: session.snapshot.time_s > 0.0)
    assert (session.snapshot.run, session.snapshot.controller) == (run, "two-part")
    ben.tab("Gains")  # to look is free
    ben.keep("visitor_looks_on")

    ben.press("Ask visitor 1 for control")
    ann.press("Hand it over")
    ben.page.get_by_text("2 visitors, you are 2: you drive").wait_for()
    ben.choose("Controller", "soft-qp")
    ben.wait_for(lambda: session.snapshot.controller == "soft-qp")

    ben.page.close()
    ann.page.get_by_text("1 visitor: the next to act drives").wait_for()
    ann.wait_for(lambda: driver().driver is None)
    ann.choose("Controller", "two-part")
    ann.wait_for(lambda: session.snapshot.controller == "two-part")
    ann.page.get_by_text("1 visitor: you drive").wait_for()
    ann.page.reload()  # a new visitor, and nobody drives
    ann.page.get_by_text("1 visitor: the next to act drives").wait_for()
    assert list(driver().visitors.values()) == [1]
