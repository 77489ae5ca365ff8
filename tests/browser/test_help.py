"""The guide is there to be read, and every key does what its line says."""

import numpy as np
import pytest

from surefoot.dashboard.messages.commands import Pause
from surefoot.dashboard.panels.help.guide import SECTIONS, equations
from surefoot.dashboard.panels.help.keys import registered
from surefoot.dashboard.panels.view.camera import CLOSER
from surefoot.dashboard.ui.mobile_layout import placed_for

pytestmark = pytest.mark.browser

PLAYWRIGHT_NAMES = {"space": "Space", "pageup": "PageUp", "pagedown": "PageDown", "home": "Home", "end": "End"}


@pytest.fixture
def frame_s():
    """Ten pictures a second: a page drawn by software then has time for keys."""
    return 0.1


def into_the_scene(screen):
    box = screen.canvas_box()
    screen.page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.1 * box["height"])


def test_every_key_reaches_its_command_and_none_does_while_typing(screen):
    session, page, server = screen.dashboard.session, screen.page, screen.dashboard.server
    snapshot = lambda: session.snapshot  # noqa: E731
    session.send(Pause())
    pressed: list[str] = []
    commands = {handle.label: handle for handle in server.gui._command_handle_from_uuid.values() if handle.hotkey}
    for handle in commands.values():
        handle.on_trigger(lambda event: pressed.append(event.target.label))
    screen.tab("Help")
    page.get_by_text("Keyboard", exact=True).last.click()
    listed = page.locator("[data-keys]")
    for _, label, _ in registered(server.gui):
        listed.get_by_text(label, exact=True).wait_for()
    screen.keep("help_keyboard")

    into_the_scene(screen)
    for label, handle in commands.items():
        keys = [part for part in (handle.modifier or "").replace("cmd/ctrl", "Control").split("+") if part]
        key = PLAYWRIGHT_NAMES.get(handle.hotkey, handle.hotkey.lower())
        page.keyboard.press("+".join([*(name.title() for name in keys), key]))
        screen.wait_for(lambda label=label: pressed and pressed[-1] == label)
    assert pressed == list(commands)  # once each

    page.keyboard.press("r")
    screen.wait_for(lambda: snapshot().playing and snapshot().time_s < 5.0)
    page.keyboard.press("Space")
    screen.wait_for(lambda: not snapshot().playing)
    before = snapshot().time_s
    page.keyboard.press("n")
    screen.wait_for(lambda: snapshot().time_s == pytest.approx(before + 0.01, abs=1e-9))
    page.keyboard.press("p")
    screen.wait_for(lambda: any(event.text.startswith("push 20 N s") for event in snapshot().events))
    page.keyboard.press("2")
    screen.wait_for(lambda: snapshot().controller == "optimization")
    (client,) = server.get_clients().values()
    for key, place in (("l", CLOSER["side"]), ("f", CLOSER["foot close-up"])):
        page.keyboard.press(key)
        seen = placed_for(place, float(client.camera.aspect))
        screen.wait_for(lambda seen=seen: np.allclose(client.camera.position, seen[0], atol=1e-2))

    by_hand = 7  # keys pressed one by one above; what a key does may be seen before its trigger is counted here
    screen.wait_for(lambda: len(pressed) == len(commands) + by_hand)
    field = page.locator("label:visible", has_text="Speed").first.locator(
        "xpath=ancestor::*[.//input[@type='text']][1]//input[@type='text']"
    )
    field.click()
    page.keyboard.type("1rpn 2")
    page.keyboard.press("Enter")
    into_the_scene(screen)
    page.keyboard.press("1")
    screen.wait_for(lambda: snapshot().controller == "two-part" and len(pressed) > len(commands) + by_hand)
    assert len(pressed) == len(commands) + by_hand + 1

    playing = snapshot().playing
    screen.press("Play / pause")
    screen.wait_for(lambda: snapshot().playing is not playing)
    page.keyboard.press("Space")  # the button has the focus: it must not be pressed as well
    screen.wait_for(lambda: snapshot().playing is playing)


def test_the_guide_shows_its_equations_and_where_they_live(screen):
    page = screen.page
    screen.dashboard.session.send(Pause())
    screen.tab("Help")
    for title in SECTIONS.values():
        page.get_by_text(title, exact=True).click()
    for name in equations():
        picture = page.locator(f"[data-equation={name}] svg")
        picture.wait_for()
        size = picture.bounding_box()
        assert size["width"] > 40.0, name
        assert size["x"] + size["width"] < 320.0, name  # inside its column
    screen.keep("help_guide")
    page.get_by_text("Equation → file", exact=True).click()
    page.get_by_text("surefoot/control/balance/ankle_law.py").first.wait_for()
    page.get_by_text("(28)", exact=True).last.wait_for()
