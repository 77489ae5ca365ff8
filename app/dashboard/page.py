"""The page: panels and views around one session, and the thread that keeps them up to date."""

import threading
import time
import traceback
from dataclasses import dataclass

import viser

from app.control.registry import controllers
from app.dashboard.footprint import SOLE_PLACES
from app.dashboard.panels.camera import CameraPanel
from app.dashboard.panels.controllers import ControllerPanel
from app.dashboard.panels.disturb import DisturbPanel
from app.dashboard.panels.equations import EquationsPanel
from app.dashboard.panels.events import EventsPanel
from app.dashboard.panels.fall import FallPanel
from app.dashboard.panels.foot import FootPanel
from app.dashboard.panels.gains import GainsPanel
from app.dashboard.panels.headroom import HeadroomPanel
from app.dashboard.panels.help import help_text, logo
from app.dashboard.panels.legend import LegendPanel
from app.dashboard.panels.narrow import suit_narrow_screens
from app.dashboard.panels.plots import PlotsPanel
from app.dashboard.panels.preset import PresetPanel
from app.dashboard.panels.run import RunPanel
from app.dashboard.panels.status import StatusPanel
from app.dashboard.panels.timeline import RepeatSwitch, TimelinePanel
from app.dashboard.session import Session
from app.dashboard.views.overlays import Overlays
from app.dashboard.views.pointer import place_on_click
from app.dashboard.views.scene import CAMERA_LOOK_AT, CAMERA_POSITION, SEE_THROUGH, SceneView
from app.experiments.scenario import shipped_scenarios
from app.robot.description import RobotDescription

FRAME_S = 1.0 / 60.0
_PLOTS_EVERY, _FOOT_EVERY, _PANELS_EVERY = 4, 5, 10  # frames
_LEFT_WIDTH, _RIGHT_WIDTH = 330, 330


@dataclass(frozen=True)
class PageStatistics:
    """How often the page is brought up to date.

    Attributes:
        frames: scene updates since the start.
        frames_per_second: over the last second or so.
        frame_ms: mean time an update took.
    """

    frames: int
    frames_per_second: float
    frame_ms: float


class Page:
    """Everything in the browser.

    Args:
        server: viser's server, still empty.
        session: what it shows and commands; running or not.
        robot: whose shapes to draw.
    """

    def __init__(self, server: viser.ViserServer, session: Session, robot: RobotDescription) -> None:
        self._server, self._session = server, session
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="surefoot-page", daemon=True)
        self.statistics = PageStatistics(0, 0.0, 0.0)
        self._set_theme(False)
        self._scene = SceneView(server, robot)
        self._overlays = Overlays(server)
        self._build()

    def start(self) -> None:
        """Start the thread that updates the page."""
        self._thread.start()

    def stop(self) -> None:
        """Stop it and wait."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join(timeout=5.0)

    def _build(self) -> None:
        gui, send, first = self._server.gui, self._session.send, self._session.snapshot
        entries = {name: entry.help for name, entry in controllers().items()}
        scenarios = {name: _first_comment(path.read_text(encoding="utf-8")) for name, path in
                     shipped_scenarios().items()}  # fmt: skip
        gui.set_panel_label("Surefoot")
        gui.main_panel.dock_right()
        gui.main_panel.set_width(_RIGHT_WIDTH)

        left = gui.add_panel()
        with left.add_tab("Balance", viser.Icon.SCALE):
            foot = FootPanel(gui, first)
            headroom = HeadroomPanel(gui, first)
            events = EventsPanel(gui, height=165)
        with left.add_tab("Plots", viser.Icon.CHART_LINE):
            plots = PlotsPanel(gui, first.limits, height=122)
        with left.add_tab("Help", viser.Icon.HELP):
            gui.add_markdown(help_text("start"))
        left.dock_left()
        left.set_width(_LEFT_WIDTH)

        status = StatusPanel(gui, logo(), first)
        run = RunPanel(gui, send, scenarios, first)
        timeline = TimelinePanel(gui, send, first)
        choice = ControllerPanel(gui, send, entries, first)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Disturb"):
            disturb = DisturbPanel(gui, send, SOLE_PLACES, first)
            repeat = RepeatSwitch(gui, send, first)
        with tabs.add_tab("Gains"):
            gains = GainsPanel(gui, send, first.settings, help_text("gains"))
            PresetPanel(gui, send, lambda: self._session.snapshot)
        with tabs.add_tab("Equations"):
            equations = EquationsPanel(gui, send, first.settings)
        with tabs.add_tab("View"):
            CameraPanel(gui, (CAMERA_POSITION, CAMERA_LOOK_AT))
            LegendPanel(gui, self._overlays.show, self._set_theme, self._scene.see_through, SEE_THROUGH)
        fall = FallPanel(gui, send)
        suit_narrow_screens(self._server, (CAMERA_POSITION, CAMERA_LOOK_AT))
        place_on_click(self._server, send, disturb.stone, lambda: self._session.snapshot.geometry.soles)
        self._plots, self._foot = plots, foot
        self._panels = (status, run, choice, disturb, gains, equations, headroom, events, timeline, repeat, fall)

    def _set_theme(self, dark: bool) -> None:
        self._server.gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)
        if hasattr(self, "_scene"):
            self._scene.set_dark(dark)

    def _run(self) -> None:
        frames, window_frames, busy = 0, 0, 0.0
        window = following = time.perf_counter()
        while not self._stop.is_set():
            started = time.perf_counter()
            try:
                self._update(frames)
            except Exception:  # a bug in a panel must not freeze the page
                traceback.print_exc()
                self._stop.wait(1.0)
            frames, window_frames = frames + 1, window_frames + 1
            now = time.perf_counter()
            busy += now - started
            if now - window >= 1.0:
                self.statistics = PageStatistics(frames, window_frames / (now - window), 1e3 * busy / window_frames)
                window, window_frames, busy = now, 0, 0.0
            following = max(following + FRAME_S, now)
            self._stop.wait(max(0.0, following - now))

    def _update(self, frame: int) -> None:
        snapshot = self._session.snapshot
        with self._server.atomic():
            self._overlays.update(snapshot.geometry)
            self._scene.update(snapshot.geometry)  # last: it flushes, and both should be seen in one frame
        self._server.flush()
        if frame % _PLOTS_EVERY == 0:
            self._plots.show(snapshot)
        if frame % _FOOT_EVERY == 1:
            self._foot.show(snapshot)
        if frame % _PANELS_EVERY == 3:
            for panel in self._panels:
                panel.show(snapshot)


def _first_comment(text: str) -> str:
    return text.partition("\n")[0].lstrip("# ").rstrip(".")
