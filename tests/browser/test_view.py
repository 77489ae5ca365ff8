"""Where a person looks from, what is drawn, in which colours, and on a telephone; real pixels."""

import numpy as np
import pytest

from surefoot.dashboard.messages.commands import LoadScenario, Pause
from surefoot.dashboard.scene.scene import CAMERA_LOOK_AT
from tests.browser.conftest import PATIENCE_MS, TOUR_SEEN, Screen
from tests.browser.test_page import shows_bip

pytestmark = pytest.mark.browser

DARK, LIGHT = 70, 170  # mean of a pixel's colours


def brightness(screen) -> tuple[float, float]:
    """Median of the 3D area and of the panel at the right."""
    size = screen.page.viewport_size
    panel = {"x": size["width"] - 60, "y": size["height"] - 160, "width": 50, "height": 140}
    return float(np.median(screen.pixels().mean(axis=2))), float(np.median(screen.shot(panel).mean(axis=2)))


def apart(one, other, by: int = 40) -> float:
    """Share of the pixels that differ by more than that in one of their colours."""
    return float((np.abs(one - other).max(axis=2) > by).mean())


def still(screen) -> np.ndarray:
    """The 3D area, once it has stopped changing."""
    seen = [screen.pixels()]

    def unchanged() -> bool:
        screen.page.wait_for_timeout(600)
        seen.append(screen.pixels())
        return apart(*seen[-2:]) < 0.002

    screen.wait_for(unchanged)
    return seen[-1]


def test_cameras_markers_and_colours(screen):
    screen.page.add_style_tag(content=".mantine-Notifications-root { display: none }")  # they come when they like
    screen.dashboard.session.send(Pause())
    screen.wait_for(lambda: not screen.dashboard.session.snapshot.playing)
    screen.wait_for(lambda: shows_bip(screen.pixels()))
    screen.tab("View")
    for place in ("side", "front", "foot close-up"):
        before = still(screen)
        screen.press(place)
        screen.wait_for(lambda before=before: apart(before, screen.pixels()) > 0.05)
        close = still(screen)
        screen.keep(f"camera_{place.replace(' ', '_')}")

    screen.page.get_by_label("Support polygon").uncheck()  # a pale blue on the ground
    screen.wait_for(lambda: apart(close, screen.pixels(), by=8) > 0.01)

    screen.page.evaluate("() => document.activeElement.blur()")
    screen.page.keyboard.press("o")  # the whole robot again
    screen.wait_for(lambda: apart(close, screen.pixels()) > 0.05)

    assert min(brightness(screen)) > LIGHT
    screen.page.get_by_label("Dark page").check()
    screen.wait_for(lambda: max(brightness(screen)) < DARK)
    screen.keep("dark")


def test_gallery_slope_and_equation_switches(screen):
    session = screen.dashboard.session
    screen.tab("Equations")
    screen.page.get_by_label("Capture guard", exact=True).uncheck()
    screen.see_event("guard = False")
    screen.choose("Other joints", "inverse-dynamics")
    screen.see_event("other_joints = inverse-dynamics")
    screen.wait_for(
        lambda: (session.snapshot.settings.guard, session.snapshot.settings.other_joints) == (False, "inverse-dynamics")
    )
    screen.keep("equations")

    screen.tab("Scenarios")
    screen.press("Figure 1: a stone under the sole")
    screen.wait_for(lambda: session.snapshot.scenario == "paper_figure1_stone")
    screen.keep("gallery")
    assert not session.snapshot.settings.guard  # controller and gains stay

    screen.tab("Disturb")
    screen.set_number("Slope", 4)
    screen.press("tilt")
    tilted = np.cos(np.deg2rad(4.0))
    screen.wait_for(lambda: session.snapshot.geometry.ground_rotation[2, 2] == pytest.approx(tilted, abs=1e-6))
    screen.keep("slope")


def test_a_telephone(screen, chromium):
    """A narrow page: Bip above, the controls below, and both can be used."""
    phone = Screen(chromium.new_page(viewport={"width": 390, "height": 844}, has_touch=True), screen.dashboard)
    phone.page.set_default_timeout(PATIENCE_MS)
    phone.page.add_init_script(TOUR_SEEN)
    phone.open()
    assert phone.page.evaluate("() => document.documentElement.scrollWidth <= window.innerWidth")
    upper = {"x": 0, "y": 40, "width": 390, "height": 400}
    phone.wait_for(lambda: shows_bip(phone.shot(upper)))
    phone.keep("phone")
    phone.page.get_by_role("button", name="outer edge", exact=True).tap()
    phone.wait_for(lambda: len(screen.dashboard.session.snapshot.geometry.stones) == 1)
    phone.keep("phone_stone")
    phone.page.get_by_role(
        "button", name="Expand panel Balance"
    ).tap()  # the second panel is a row at the end of the sheet
    phone.see_event("rises under the left sole")
    phone.keep("phone_balance")
    phone.page.close()


def test_the_camera_goes_with_a_walk_until_its_person_does_not_want_it(screen):
    def looks_at() -> np.ndarray:
        (client,) = screen.dashboard.server.get_clients().values()
        return client.camera.look_at

    screen.tab("View")
    screen.dashboard.session.send(LoadScenario("walk_flat"))
    screen.wait_for(lambda: looks_at()[0] > 0.2)
    screen.keep("walking")
    screen.tab("Walk")
    screen.press("turn left")
    screen.see_event("steered: steps of 0.2 m, turn 5° each")
    screen.page.get_by_role("status").get_by_text("20 cm each, 5° to the left").wait_for()
    screen.tab("View")
    screen.page.get_by_label("Follow the robot").uncheck()
    screen.press("Reset")
    screen.see_event("reset: scenario walk_flat")
    assert looks_at()[0] > 0.2
    screen.press("whole robot")
    screen.wait_for(lambda: looks_at() == pytest.approx(CAMERA_LOOK_AT, abs=1e-3))

    def ahead() -> float:
        """How far the robot is from where it is looked for [m]."""
        return abs(float(screen.dashboard.session.snapshot.geometry.com[0] - looks_at()[0]))

    screen.wait_for(lambda: ahead() > 0.6)
    screen.open()  # who comes late looks at where the robot is, and not at its start
    screen.wait_for(lambda: len(screen.dashboard.server.get_clients()) == 1 and ahead() < 0.5)
