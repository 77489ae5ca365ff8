"""What a person sees of the theory: the close-up, the limits, the plots; and what can be kept of them."""

import csv
import io

import numpy as np
import pytest
from PIL import Image

from surefoot.dashboard.panels.balance.foot_plan import HEIGHT, WIDTH, plan_of
from surefoot.dashboard.ui import palette

pytestmark = pytest.mark.browser


PLAN = "[aria-label='Soles seen from above']"


def plan_pixels(screen) -> np.ndarray:
    """The close-up as it is on the screen; its element is made again all the time."""
    box = screen.page.evaluate(f'(b => [b.x, b.y, b.width, b.height])(document.querySelector("{PLAN}")'
                               ".getBoundingClientRect())")  # fmt: skip
    shot = screen.page.screenshot(clip=dict(zip(("x", "y", "width", "height"), box, strict=True)))
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)


def middle_of(pixels: np.ndarray, colour) -> np.ndarray:
    """Where a colour is, as a share of width and height; NaN when it is nowhere."""
    found = np.argwhere(np.abs(pixels - colour).max(axis=2) < 30)
    return found.mean(axis=0)[::-1] / pixels.shape[1::-1] if len(found) > 8 else np.full(2, np.nan)


def test_a_push_is_seen_in_the_close_up_and_measured_against_the_bound(screen):
    page, session = screen.page, screen.dashboard.session
    page.locator(PLAN).wait_for()
    snapshot = session.snapshot
    expected = plan_of(snapshot.geometry, "left", snapshot.robot).point(snapshot.geometry.zmp_measured) / (
        WIDTH,
        HEIGHT,
    )
    screen.wait_for(lambda: np.allclose(middle_of(plan_pixels(screen), palette.ZMP_MEASURED), expected, atol=0.02))
    screen.wait_for(lambda: page.locator("[data-margin]").inner_text() == "74 mm")
    page.get_by_text("No push yet").wait_for()

    screen.press("Push now")
    page.locator("[data-eta]").wait_for()
    push = session.snapshot.headroom.push
    assert page.locator("[data-eta]").inner_text() == f"{push.eta:.2f}"
    page.get_by_text("J 20 N·s left in 100 ms").wait_for()
    screen.wait_for(lambda: "nearest" in page.locator("[data-nearest]").inner_text())
    screen.keep("balance")

    errors = []
    page.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    screen.choose("Scenario", "stand_double")
    screen.wait_for(lambda: session.snapshot.support == "double")
    screen.wait_for(lambda: page.locator("[data-margin]").inner_text() == "140 mm")
    sky = np.array(palette.POLYGON) * 0.28 + 255.0 * 0.72
    screen.wait_for(lambda: (np.abs(plan_pixels(screen) - sky).max(axis=2) < 25).mean() > 0.2)
    screen.keep("balance_double")
    assert errors == []


def test_plots_are_chosen_held_and_kept(screen):
    page, session = screen.page, screen.dashboard.session
    screen.tab("Plots")
    page.get_by_text("Lateral from P [mm]").wait_for()
    page.get_by_text("Choose plots, keep data").click()
    page.get_by_label("Contact forces", exact=True).click()
    page.get_by_text("Force on each foot").wait_for()
    page.get_by_label("Margins", exact=True).click()  # a fifth: the one chosen longest ago makes room
    page.get_by_text("Distance to the sole's edge").wait_for()
    page.get_by_text("Lateral from P [mm]").wait_for(state="hidden")
    assert not page.get_by_label("Lateral: ZMP, CoM", exact=True).is_checked()

    screen.wait_for(lambda: session.snapshot.time_s > 3.0)
    page.get_by_label("Hold the plots", exact=True).click()
    with page.expect_download() as download:
        screen.press("save CSV")
    rows = list(csv.DictReader(io.StringIO(download.value.path().read_text())))
    assert {"time_s", "force_left_n", "dcm_margin_mm"} <= set(rows[0])
    assert "zmp_y_mm" not in rows[0]
    assert float(rows[-1]["force_left_n"]) == pytest.approx(1028.0, abs=5.0)
    with page.expect_download() as download:
        screen.press("save PNG")
    assert Image.open(download.value.path()).size[0] > 500
    screen.keep("plots")
