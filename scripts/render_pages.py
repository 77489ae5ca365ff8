"""Draw the README's pictures of the page: static/dashboard.png, static/twin.gif and static/walk.gif.

    python scripts/render_pages.py [dashboard] [twin] [walk]

A real run in a real browser, stepped; the animations play at half the real speed.
"""

import io
import sys
from collections.abc import Callable
from pathlib import Path

import playwright.sync_api as api
from browser import ARGUMENTS, PATH, PATIENCE_MS, TOUR_SEEN
from PIL import Image

from surefoot.dashboard.launch import Dashboard, start_dashboard
from surefoot.dashboard.messages.commands import (
    Command,
    LoadScenario,
    PlaceStoneAtSole,
    PushNow,
    Reset,
    StartTwin,
    Step,
)

STATIC = Path(__file__).resolve().parent.parent / "static"
SIZE = {"width": 1280, "height": 800}
FRAME_TICKS, FRAMES, SLOWER = 40, 62, 2
WALK_FROM_S, WALK_TICKS, WALK_FRAMES = 3.0, 80, 36  # four steps
STEP_TICKS = 1000
WIDTH_PX, COLOURS = 720, 128
DRAWN = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"


class Stepped:
    """A page whose robots move only when they are asked to, so that every instant is seen on the slowest machine."""

    def __init__(self, page: api.Page, dashboard: Dashboard) -> None:
        self.page, self.dashboard, self.session = page, dashboard, dashboard.session
        self.do(Reset(play=False))

    def wait_for(self, condition: Callable[[], bool]) -> None:
        """Wait for a condition in this process."""
        while not condition():
            self.page.wait_for_timeout(50)

    def do(self, *commands: Command) -> None:
        """Ask for things; returns when a picture taken after them is there."""
        for command in commands:
            self.session.send(command)
        number = self.session.snapshot.number
        self.wait_for(lambda: self.session.snapshot.number > number + 3)

    def go(self, ticks: int) -> None:
        """Let time pass."""
        until = self.session.snapshot.time_s + 1e-3 * ticks - 1e-6
        while ticks > 0:
            self.session.send(Step(min(ticks, STEP_TICKS)))  # the most that one of them goes
            ticks -= STEP_TICKS
        self.wait_for(lambda: self.session.snapshot.time_s > until)

    def drawn(self) -> Image.Image:
        """The page, once it shows the newest picture."""
        number = self.session.snapshot.number + 2
        self.wait_for(lambda: self.dashboard.page.shown.number > number)
        self.page.wait_for_timeout(300)  # the 2D drawings come a few times a second
        self.page.evaluate(DRAWN)
        return Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")


def draw_dashboard(stepped: Stepped) -> None:
    """One robot, a stone under its foot, and a push."""
    stepped.go(1000)
    stepped.do(PlaceStoneAtSole(place="outer edge", height_m=0.012, size_m=0.06))
    stepped.go(2500)
    stepped.do(PushNow(direction_deg=0.0, impulse_ns=6.0, duration_s=0.1))
    for _ in range(20):  # as many rows of the plots as a live run has
        stepped.go(25)
        picture = stepped.drawn()
    picture.save(STATIC / "dashboard.png", optimize=True)


def draw_twin(stepped: Stepped) -> None:
    """One stone under two controllers."""
    session = stepped.session
    session.send(StartTwin("optimization"))
    stepped.wait_for(lambda: session.snapshot.twin is not None and session.snapshot.twin.other is not None)
    stepped.page.get_by_role("tab", name="Twin", exact=True).click()
    stepped.do(Reset(play=False))
    stepped.go(500)
    stepped.do(PlaceStoneAtSole(place="outer edge", height_m=0.012, size_m=0.06))
    frames = []
    for _ in range(FRAMES):
        stepped.go(FRAME_TICKS)
        frames.append(stepped.drawn())
    save_animation(frames, "twin.gif", FRAME_TICKS)


def draw_walk(stepped: Stepped) -> None:
    """A stone under every step."""
    stepped.do(LoadScenario("walk_stones"), Reset(play=False))
    stepped.go(round(1e3 * WALK_FROM_S))
    frames = []
    for _ in range(WALK_FRAMES):
        stepped.go(WALK_TICKS)
        frames.append(stepped.drawn())
    save_animation(frames, "walk.gif", WALK_TICKS)


def save_animation(frames: list[Image.Image], name: str, frame_ticks: int) -> None:
    """Frames that are so many ticks apart, small and in one palette, the last one for longer."""
    small = [frame.resize((WIDTH_PX, WIDTH_PX * SIZE["height"] // SIZE["width"]), Image.Resampling.LANCZOS)
             for frame in frames]  # fmt: skip
    palette = small[-1].quantize(COLOURS)  # one for all: what stands still stays the same from frame to frame
    first, *others = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in small]
    each_ms = frame_ticks * SLOWER
    first.save(STATIC / name, save_all=True, append_images=others, loop=0, optimize=True,
               duration=[*[each_ms] * len(others), 3000])  # fmt: skip


PICTURES = {"dashboard": draw_dashboard, "twin": draw_twin, "walk": draw_walk}


def main() -> None:
    """Draw the pictures named, or all."""
    names = sys.argv[1:] or list(PICTURES)
    if unknown := [name for name in names if name not in PICTURES]:
        sys.exit(f"no such picture: {', '.join(unknown)} (valid: {', '.join(PICTURES)})")
    with api.sync_playwright() as running:
        browser = running.chromium.launch(executable_path=PATH, args=ARGUMENTS)
        for name in names:
            dashboard = start_dashboard(port=0)
            page = browser.new_page(viewport=SIZE)  # type: ignore[arg-type]
            page.set_default_timeout(PATIENCE_MS)
            page.add_init_script(TOUR_SEEN)
            page.goto(dashboard.address)
            page.get_by_label("Controller", exact=True).wait_for()
            page.get_by_text("Software WebGL rendering detected").wait_for()  # viser's complaint about this browser
            page.locator(".mantine-Notification-closeButton").first.click()
            PICTURES[name](Stepped(page, dashboard))
            page.close()
            dashboard.stop()
        browser.close()


if __name__ == "__main__":
    main()
