"""The page as a person with a robot of their own uses it: stone by click, push, twin, rewind, files, page from disk."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from surefoot.dashboard.live.rerun import rerun
from surefoot.experiments.runs.comparison import difference
from surefoot.experiments.runs.run_reader import read_run

pytestmark = pytest.mark.browser
PLAN = '[aria-label="Soles seen from above"]'


def has_robot(pixels: np.ndarray) -> bool:
    """Something before the ground and the sky: many edges between light and dark."""
    grey = pixels[..., :3].astype(int).mean(axis=2)
    return int((np.abs(np.diff(grey, axis=1)) > 25).sum()) > 300


def heights(snapshot) -> list[float]:
    return [round(1e3 * view.stone.height_m, 6) for view in snapshot.geometry.stones]


def test_a_person_with_another_robot(other_robot, tmp_path):
    screen, page, session = other_robot, other_robot.page, other_robot.dashboard.session
    robot = session.snapshot.robot
    screen.wait_for(lambda: session.snapshot.time_s > 0.2)
    screen.wait_for(lambda: has_robot(screen.pixels()))
    outlines = page.locator(f'{PLAN} polygon[stroke-linejoin="round"]')
    corners = [float(x) for svg in outlines.all() for x in re.findall(r"([-\d.]+),", svg.get_attribute("points"))]
    assert 0.0 < min(corners) < max(corners) < 310.0  # both soles
    screen.keep(f"robot_{robot.title}")

    screen.tab("Twin")
    screen.press("Start twin run")
    page.get_by_text("no divergence yet").wait_for()  # both have been put to the start, without any stone
    height = screen.number_box("Stone height").input_value()
    assert 1 <= int(height) < 10
    sole = session.snapshot.geometry.soles[0]
    under = sole.mean(axis=0) + (0.0, 0.3 * np.ptp(sole[:, 1]), 0.0)
    page.keyboard.down("Control")
    page.mouse.click(*screen.where(under))
    page.keyboard.up("Control")
    screen.tab("Balance")
    screen.see_event(f"stone {height} mm high")
    screen.see_event("rises under the left sole")
    screen.wait_for(lambda: heights(session.snapshot) == heights(session.snapshot.twin.other) == [float(height)])

    impulse = float(screen.number_box("Impulse").input_value())
    assert 1.0 < impulse < 10.0
    screen.set_number("Impulse", round(impulse, 1))
    screen.press("Push now")
    page.locator("[data-eta]").wait_for()
    page.get_by_text(f"J {impulse:g} N·s left").wait_for()
    screen.wait_for(lambda: session.snapshot.time_s > session.snapshot.headroom.push.start_s + 0.5)
    screen.press("Play / pause")
    screen.wait_for(lambda: not session.snapshot.playing)
    screen.keep(f"robot_{robot.title}_pushed")
    before = session.snapshot
    assert before.balance.fall_cause is None

    screen.set_number("t [s]", round(before.time_s - 0.3, 3))
    screen.wait_for(lambda: session.snapshot.time_s < before.time_s - 0.29)
    screen.set_number("t [s]", round(before.time_s, 3))
    screen.wait_for(lambda: abs(session.snapshot.time_s - before.time_s) < 1e-6)
    assert session.snapshot.geometry.qpos.tobytes() == before.geometry.qpos.tobytes()

    screen.tab("Export")
    files = {}
    for button in ("NPZ", "MCAP", "Picture (PNG)", "Replay page (HTML)"):
        with page.expect_download() as download:
            screen.press(button)
        files[button] = tmp_path / download.value.suggested_filename
        download.value.save_as(files[button])
    run = read_run(files["NPZ"])
    assert run.manifest["robot"] == robot.key
    assert difference(run, rerun(run)) is None
    assert has_robot(np.asarray(Image.open(io.BytesIO(files["Picture (PNG)"].read_bytes()))))
    screen.open_recording(files["Replay page (HTML)"])
    screen.wait_for(lambda: has_robot(screen.pixels()))
    screen.keep(f"robot_{robot.title}_html")
