"""The page as a person uses it who wants to see a robot that does not know its state."""

import numpy as np
import pytest

from surefoot.dashboard.messages.commands import Pause
from surefoot.dashboard.page import RIGHT_TABS

pytestmark = pytest.mark.browser


def cyan(pixels: np.ndarray) -> int:
    """Pixels as the ghost has them: red far below green and blue, which are alike."""
    red, green, blue = (pixels[..., i].astype(int) for i in range(3))
    return int(((np.minimum(green, blue) - red > 40) & (np.abs(green - blue) < 40)).sum())


def test_a_person_takes_the_true_state_away(screen):
    page, session = screen.page, screen.dashboard.session
    screen.wait_for(lambda: session.snapshot.time_s > 0.1)
    screen.tab("Sensors")
    page.get_by_text("which no robot has").wait_for()
    rows = {page.get_by_role("tab", name=tab.label, exact=True).bounding_box()["y"] for tab in RIGHT_TABS}
    assert len(rows) == 1
    before = cyan(screen.pixels())
    screen.choose("Sensors", "cheap")
    page.get_by_text("Nobody reads these sensors").wait_for()
    screen.choose("Estimator", "anchor")
    page.get_by_text("what anchor makes of the sensors").wait_for()
    screen.wait_for(lambda: session.snapshot.geometry.believed is not None and session.snapshot.time_s > 1.0)
    session.send(Pause())
    screen.tab("Balance")
    page.get_by_text("assumed support").wait_for()
    page.locator("polygon[data-assumed]").wait_for(state="attached")
    screen.wait_for(lambda: cyan(screen.pixels()) > before + 500)
    screen.tab("Plots")
    page.get_by_text("Choose plots, keep data").click()
    page.get_by_label("DCM error", exact=True).click()
    page.get_by_text("Believed less true DCM [mm], 3σ dashed").wait_for()
    screen.keep("sensors")
    screen.tab("Sensors")
    screen.choose("Motors", "robot")
    screen.wait_for(lambda: session.snapshot.sensing.motors.preset == "robot")
    assert session.snapshot.sensing.estimator == "anchor"
    screen.choose("Estimator", "truth")
    screen.wait_for(lambda: not session.snapshot.sensing.estimating)
    page.get_by_text("Believed less true DCM [mm], 3σ dashed").wait_for(state="hidden")
