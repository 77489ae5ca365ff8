"""A browser without WebGL: it says so in words, and everything but the 3D view works."""

import pytest

from tests.browser.chromium import ARGUMENTS, CHROMIUM

pytestmark = pytest.mark.browser


@pytest.fixture
def chromium(chromium_path):
    pytest.importorskip("playwright.sync_api")
    return CHROMIUM.started(chromium_path, (*ARGUMENTS, "--disable-3d-apis"))


def test_the_page_says_what_is_missing_and_all_else_works(screen):
    page, session = screen.page, screen.dashboard.session
    mishaps = []
    page.on("pageerror", lambda error: mishaps.append(str(error)))
    notice = page.get_by_role("status", name="Why there is no 3D view")
    notice.wait_for()
    said = notice.inner_text()
    assert "The 3D view needs WebGL" in said
    assert "webgl.disabled" in said and "surefoot run" in said

    page.keyboard.down("Control")
    notice.click()  # what would put a stone down, in a scene that nobody sees
    page.keyboard.up("Control")
    screen.see_event("scenario stand_left")
    screen.press("outer edge")
    screen.see_event("stone 10 mm high")
    assert len(session.snapshot.geometry.stones) == 1
    screen.press("Play / pause")
    screen.wait_for(lambda: not session.snapshot.playing)
    screen.set_number("Speed [×]", 0.5)
    screen.wait_for(lambda: session.snapshot.speed == 0.5)
    page.get_by_text("solved").first.wait_for()
    screen.tab("Plots")
    page.locator(".uplot canvas").first.wait_for()
    screen.keep("without_webgl")
    screen.tab("Export")
    screen.press("Picture (PNG)")
    page.get_by_text("this browser draws no 3D view").wait_for()
    assert mishaps == []
