"""What a person takes away and gives to others: files, a picture, a page, a link; and what opens them again."""

import io

import numpy as np
import pytest
from PIL import Image

from surefoot.dashboard.live.rerun import rerun
from surefoot.dashboard.messages.commands import Reset
from surefoot.dashboard.replay.replay_page import start_replay
from surefoot.experiments.runs.comparison import difference
from surefoot.experiments.runs.run_reader import read_run

pytestmark = pytest.mark.browser


def has_bip(pixels: np.ndarray) -> bool:
    """Orange strips of the trunk and dark motors: neither belongs to ground, sky or a blank page."""
    red, green, blue = np.moveaxis(pixels[..., :3].astype(int), 2, 0)
    orange = (red > 170) & (red - blue > 80) & (green > 80) & (green < 190)
    dark = (red < 90) & (green < 90) & (blue < 95)
    return bool(orange.sum() > 60 and dark.sum() > 60)


def test_a_run_is_kept_pictured_and_replayed(screen, tmp_path):
    page, session = screen.page, screen.dashboard.session
    run = session.snapshot.run
    session.send(Reset())  # a short run: seconds passed while the page was opened
    screen.wait_for(lambda: session.snapshot.run > run)
    screen.press("outer edge")
    screen.see_event("stone 10 mm high")
    screen.wait_for(lambda: session.snapshot.time_s > session.snapshot.geometry.stones[0].stone.rise_start_s + 0.5)
    screen.press("Play / pause")
    screen.wait_for(lambda: not session.snapshot.playing)
    screen.tab("Export")
    files = {}
    for button in ("NPZ", "Picture (PNG)", "Replay page (HTML)"):
        with page.expect_download() as download:
            screen.press(button)
        files[button] = tmp_path / download.value.suggested_filename
        download.value.save_as(files[button])
    assert files["NPZ"].name == "surefoot-stand_left-two-part.npz"
    run = read_run(files["NPZ"])
    assert run.manifest["stones"][0]["stone"]["height_m"] == 0.01
    assert difference(run, rerun(run)) is None
    assert has_bip(np.asarray(Image.open(files["Picture (PNG)"])))

    screen.open_recording(files["Replay page (HTML)"])
    screen.wait_for(lambda: has_bip(screen.pixels()))
    screen.keep("replay_page")

    address, player, server = start_replay(run, host="127.0.0.1", port=0, token=None)
    try:
        page.goto(address)
        page.get_by_text("Time [s]", exact=True).wait_for()
        screen.wait_for(lambda: has_bip(screen.pixels()))
        screen.set_number("Time [s]", 0.25)
        screen.wait_for(lambda: not player.playing and abs(player.time_s - 0.25) < 1e-6)
        screen.keep("replay_scrubbed")
    finally:
        player.stop()
        server.stop()


def test_a_link_starts_what_it_says_and_says_so(screen):
    page, session = screen.page, screen.dashboard.session
    screen.tab("Export")
    screen.choose("Controller", "optimization")
    link = page.get_by_role("link", name="controller=optimization")
    link.wait_for()
    assert "scenario=stand_left" in link.inner_text()

    run = session.snapshot.run
    page.goto(f"{screen.dashboard.address}/?scenario=push_left&controller=soft-qp&controller.com_stiffness=80")
    page.get_by_text("Started from the link").wait_for()
    screen.wait_for(lambda: session.snapshot.run == run + 1)
    snapshot = session.snapshot
    assert (snapshot.scenario, snapshot.controller, snapshot.settings.com_stiffness) == ("push_left", "soft-qp", 80.0)
    screen.keep("link")

    page.goto(f"{screen.dashboard.address}/?scenario=nowhere")
    page.get_by_text("The link could not be used").wait_for()
    screen.see_event("no such scenario")
    assert session.snapshot.scenario == "push_left"


def test_a_page_of_another_place_cannot_use_a_link_unseen(screen):
    """An image or a frame elsewhere may ask for the address; nothing happens."""
    page, session = screen.page, screen.dashboard.session
    run = session.snapshot.run
    address = f"{screen.dashboard.address}/?scenario=push_left"
    other = page.context.browser.new_page()
    other.set_content(f'<img src="{address}"><iframe src="{address}"></iframe>')
    other.wait_for_load_state("load")
    page.reload()
    page.get_by_label("Controller", exact=True).wait_for()
    screen.choose("Controller", "soft-qp")
    screen.see_event("controller two-part -> soft-qp")
    assert (session.snapshot.run, session.snapshot.scenario) == (run, "stand_left")


def test_pictures_can_be_read_from_bytes():
    from surefoot.dashboard.panels.export.run_files import png_bytes

    pixels = np.zeros((4, 5, 3), dtype=np.uint8)
    pixels[1, 2] = (1, 2, 3)
    assert (np.asarray(Image.open(io.BytesIO(png_bytes(pixels)))) == pixels).all()
