"""A real page in a real Chromium, and the tools to look at it."""

import io
import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from surefoot.dashboard.engine.threads import SWITCH
from surefoot.dashboard.launch import start_dashboard
from surefoot.dashboard.messages.commands import Pause
from surefoot.dashboard.messages.shown_robot import view_scale
from surefoot.dashboard.scene.scene import CAMERA_FOV_RAD, CAMERA_LOOK_AT, CAMERA_POSITION
from surefoot.experiments.scenario.robots import robot_named
from surefoot.robot.description import available_robots
from tests.browser.chromium import ARGUMENTS, CHROMIUM
from tests.support.humanoids import path_of

PATIENCE_MS = 300_000
os.environ.setdefault(SWITCH, "0")  # a browser that draws in software on a slow machine needs its share too
TOUR_SEEN = "localStorage.setItem('viser-user:surefoot-tour', 'seen')"
_LARGEST_CANVAS = """() => [...document.querySelectorAll('canvas')]
  .map((canvas) => canvas.getBoundingClientRect())
  .filter((box) => box.width * box.height > 0)
  .sort((a, b) => b.width * b.height - a.width * a.height)
  .map(({x, y, width, height}) => ({x, y, width, height}))[0]"""
_PLAYS = "() => [...document.querySelectorAll('input')].some((box) => /^\\d+\\.\\d$/.test(box.value) && box.value > 0)"
# A page lags behind the run: the end of the timeline's slider may not have come there yet
_IN_RANGE = """([box, value]) => {
  for (let row = box, up = 0; row && up < 4; row = row.parentElement, up += 1) {
    const slider = row.querySelector('[role=slider]');
    if (slider) return slider.getAttribute('aria-valuemin') <= value && value <= slider.getAttribute('aria-valuemax');
  }
  return true;
}"""
ARTEFACTS = Path(os.environ.get("SUREFOOT_ARTEFACTS", Path(__file__).resolve().parents[2] / "artefacts"))


class Screen:
    """What a person does and sees.

    Args:
        page: Playwright's page.
        dashboard: the running dashboard behind it.
    """

    def __init__(self, page, dashboard) -> None:
        self.page, self.dashboard = page, dashboard

    def open(self) -> None:
        self.page.goto(self.dashboard.address)
        self.settle()

    def open_recording(self, file: Path) -> None:
        """A page from disk, stopped while it plays, in a small window.

        Played on, it makes its whole scene anew whenever it starts over, and software draws it all the time.
        """
        self.page.set_viewport_size({"width": 560, "height": 420})
        self.page.goto(f"file://{file}")
        self.page.wait_for_function(_PLAYS)
        self.page.keyboard.press("Space")

    def settle(self) -> None:
        """Wait for the controls, and keep viser's complaint about software rendering out of the way."""
        self.page.get_by_label("Controller", exact=True).wait_for()
        alert = self.page.get_by_text("Software WebGL rendering detected")
        self.page.add_locator_handler(
            alert, lambda: self.page.locator(".mantine-Notification-closeButton").first.dispatch_event("click")
        )

    def choose(self, label: str, option: str) -> None:
        self.page.get_by_label(label, exact=True).click()
        self.page.get_by_role("option", name=option, exact=True).click()

    def press(self, button: str) -> None:
        self.page.get_by_role("button", name=button, exact=True).click()

    def tab(self, name: str) -> None:
        self.page.get_by_role("tab", name=name, exact=True).click()

    def number_box(self, label: str):
        """The number box of a slider."""
        row = self.page.locator("label:visible", has_text=label).first
        return row.locator("xpath=ancestor::*[.//input[@type='text']][1]").locator("input[type=text]").first

    def set_number(self, label: str, value: float) -> None:
        """Put a number into the number box of a slider, as soon as that reaches so far."""
        self.page.wait_for_function(_IN_RANGE, arg=[self.number_box(label).element_handle(), value])
        self.number_box(label).fill(str(value))
        self.number_box(label).press("Enter")

    def see_event(self, text: str) -> None:
        """Wait until the log shows a text."""
        self.page.get_by_role("log").get_by_text(text).first.wait_for()

    def canvas_box(self) -> dict[str, float]:
        """Where the 3D area is, the largest canvas; a page that was just opened has none yet."""
        return self.page.wait_for_function(_LARGEST_CANVAS).json_value()

    def where(self, point) -> tuple[float, float]:
        """Where a world point is drawn, seen through the default camera, which is nearer to a smaller robot."""
        scale = view_scale(robot_named(self.dashboard.session.snapshot.robot.key))
        box, eye, target = self.canvas_box(), scale * np.array(CAMERA_POSITION), scale * np.array(CAMERA_LOOK_AT)
        ahead = (target - eye) / np.linalg.norm(target - eye)
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        ray = np.array(point) - eye
        scale = 0.5 * box["height"] / np.tan(0.5 * CAMERA_FOV_RAD) / ray.dot(ahead)
        x, y = ray.dot(right) * scale, ray.dot(np.cross(right, ahead)) * scale
        return box["x"] + 0.5 * box["width"] + x, box["y"] + 0.5 * box["height"] - y

    def pixels(self) -> np.ndarray:
        """The middle of the 3D area (h, w, 3)."""
        box = self.canvas_box()
        return self.shot({
            "x": box["x"] + 0.2 * box["width"], "y": box["y"] + 0.05 * box["height"],
            "width": 0.6 * box["width"], "height": 0.9 * box["height"],
        })  # fmt: skip

    def shot(self, clip: dict[str, float]) -> np.ndarray:
        """A part of the page (h, w, 3)."""
        picture = self.page.screenshot(clip=clip)
        return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB")).astype(int)

    def wait_for(self, condition, describe=lambda: "") -> None:
        """Wait for a condition in this process; the deadline only keeps a broken program from hanging.

        Args:
            condition: what to wait for.
            describe: says how things stand when it never comes true.
        """
        for _ in range(PATIENCE_MS // 200):
            if condition():
                return
            self.page.wait_for_timeout(200)
        raise AssertionError(f"waited in vain {describe()}")

    def keep(self, name: str) -> None:
        """Keep a screenshot."""
        ARTEFACTS.mkdir(parents=True, exist_ok=True)
        self.page.screenshot(path=ARTEFACTS / f"{name}.png")

    def describe(self) -> str:
        """How things stand, in the session and on the page."""
        snapshot = self.dashboard.session.snapshot
        events = "\n".join(f"{event.time_s:.3f} {event.text}" for event in snapshot.events[-12:])
        focused = self.page.evaluate("document.activeElement.outerHTML.slice(0, 200)")
        state = f"t = {snapshot.time_s:.4f} s, playing {snapshot.playing}, {snapshot.controller}, {snapshot.timeline}"
        return f"{state}\n{events}\nfocus: {focused}\npage: {self.page.locator('body').inner_text()}"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """What stood on the page when a test failed belongs to the report: the page is gone when it is read."""
    report = yield
    if report.when == "call" and report.failed:
        given = [item.funcargs.get(name) for name in ("screen", "newcomer", "other_robot", "visitors")]
        for number, shown in enumerate(flat(given)):
            try:
                shown.keep(f"failed_{item.name}_{number}")
                report.sections.append((f"page {number}", shown.describe()))
            except Exception as error:  # the browser may be what failed
                report.sections.append((f"page {number}", repr(error)))
    return report


def flat(given) -> list[Screen]:
    return [shown for one in given if one is not None for shown in (one if isinstance(one, list) else [one])]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(item, nextitem):
    """Close Chromium behind the last test of this folder: others may want an event loop of their own."""
    done = yield
    if nextitem is None or Path(__file__).parent not in nextitem.path.parents:
        CHROMIUM.close()
    return done


@pytest.fixture
def chromium(chromium_path):
    pytest.importorskip("playwright.sync_api")
    return CHROMIUM.started(chromium_path, ARGUMENTS)


@pytest.fixture
def frame_s():
    """How often a page is shown something new [s]: what software draws. A file that needs another gives its own."""
    return 0.05


@pytest.fixture
def newcomer(chromium, frame_s, monkeypatch):
    """Someone who has never been here: the tour is offered."""
    monkeypatch.setattr("surefoot.dashboard.page.FRAME_S", frame_s)
    yield from visit(chromium, "")


@pytest.fixture
def screen(chromium, frame_s, monkeypatch):
    """Someone who has closed the tour before."""
    monkeypatch.setattr("surefoot.dashboard.page.FRAME_S", frame_s)
    yield from visit(chromium, TOUR_SEEN)


@pytest.fixture(params=["offset", pytest.param("g1", marks=pytest.mark.robots)])
def other_robot(chromium, request, monkeypatch):
    """A page that was started with another robot: ours, or one of others where the extra is installed.

    It is shown ten times a second: of two robots made of meshes that is what software draws.
    """
    monkeypatch.setattr("surefoot.dashboard.page.FRAME_S", 0.1)
    robot = request.param if request.param in available_robots() else str(path_of(request.param))
    yield from visit(chromium, TOUR_SEEN, robot)


@pytest.fixture
def visitors(chromium, monkeypatch):
    """Two browsers with nothing in common, and a dashboard with a token that neither has opened yet.

    It stands still and is shown ten times a second, so that two pages drawn by software have less to do.
    """
    monkeypatch.setattr("surefoot.dashboard.page.FRAME_S", 0.1)
    dashboard = start_dashboard(port=0, token="abcdefgh12345678")
    dashboard.session.send(Pause())
    contexts = [chromium.new_context(viewport={"width": 760, "height": 460}) for _ in range(2)]
    screens = []
    for context in contexts:
        context.add_init_script(TOUR_SEEN)
        page = context.new_page()
        page.set_default_timeout(PATIENCE_MS)
        screens.append(Screen(page, dashboard))
    yield screens
    for context in contexts:
        context.close()
    dashboard.stop()


def visit(chromium, memory: str, robot: str | None = None):
    dashboard = start_dashboard(port=0, robot=robot)
    page = chromium.new_page(viewport={"width": 1100, "height": 700})
    page.set_default_timeout(PATIENCE_MS)
    if memory:
        page.add_init_script(memory)
    shown = Screen(page, dashboard)
    shown.open()
    yield shown
    page.close()
    dashboard.stop()
