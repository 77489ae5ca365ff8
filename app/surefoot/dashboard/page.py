"""The page: panels and views around one session, and the thread that keeps them up to date."""

import time
from collections.abc import Callable

import viser

from surefoot.control.registry import controllers
from surefoot.dashboard.access.client_context import ClientGuard, current_client
from surefoot.dashboard.access.driver_lock import DriverLock
from surefoot.dashboard.access.ports import page_address
from surefoot.dashboard.engine.frame_clock import FrameClock, PageStatistics
from surefoot.dashboard.engine.loop_thread import LoopThread
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.engine.thread_priority import SHOWS
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.messages.sole_places import SOLE_PLACES
from surefoot.dashboard.panels.balance.event_steps import EventSteps
from surefoot.dashboard.panels.balance.events import EventsPanel
from surefoot.dashboard.panels.balance.foot import FootPanel
from surefoot.dashboard.panels.balance.limits import HeadroomPanel
from surefoot.dashboard.panels.compare.ab_slots import SlotsPanel
from surefoot.dashboard.panels.disturb.disturb import DisturbPanel
from surefoot.dashboard.panels.disturb.stone_preview import aimed_stone
from surefoot.dashboard.panels.disturb.stones import StonesPanel
from surefoot.dashboard.panels.export.export import ExportPanel
from surefoot.dashboard.panels.header.controller import ControllerPanel
from surefoot.dashboard.panels.header.fall import FallPanel
from surefoot.dashboard.panels.header.run import RunPanel
from surefoot.dashboard.panels.header.status import StatusPanel
from surefoot.dashboard.panels.header.timeline import RepeatSwitch, TimelinePanel
from surefoot.dashboard.panels.header.visitors import VisitorsPanel
from surefoot.dashboard.panels.help.guide import add_guide
from surefoot.dashboard.panels.help.keys import KeysPanel
from surefoot.dashboard.panels.help.tour import Tour
from surefoot.dashboard.panels.plots.plots import PlotsPanel
from surefoot.dashboard.panels.scenarios.catalogue import gallery
from surefoot.dashboard.panels.scenarios.gallery import GalleryPanel
from surefoot.dashboard.panels.tuning.equations import EquationsPanel
from surefoot.dashboard.panels.tuning.gains import GainsPanel
from surefoot.dashboard.panels.tuning.preset_files import shipped_presets
from surefoot.dashboard.panels.tuning.undo import undo_keys
from surefoot.dashboard.panels.twin.twin import TwinPanel
from surefoot.dashboard.panels.view.camera import CameraPanel
from surefoot.dashboard.panels.view.legend import LegendPanel
from surefoot.dashboard.scene.click_to_place import Place, stones_on_click
from surefoot.dashboard.scene.drag_pull import Grip
from surefoot.dashboard.scene.markers import Overlays
from surefoot.dashboard.scene.scene import CAMERA_LOOK_AT, CAMERA_POSITION, SEE_THROUGH, SceneView
from surefoot.dashboard.scene.stone_preview import Preview
from surefoot.dashboard.scene.twin_scene import ARRANGEMENTS, TwinScene
from surefoot.dashboard.ui.help_text import help_text, logo
from surefoot.dashboard.ui.mobile_layout import suit_narrow_screens
from surefoot.robot.description import RobotDescription

FRAME_S = 1.0 / 60.0
_PLOTS_EVERY, _FOOT_EVERY, _PANELS_EVERY = 4, 5, 10  # frames
_LEFT_WIDTH, _RIGHT_WIDTH = 330, 330


class Page:
    """Everything in the browser.

    Args:
        server: viser's server, still empty.
        session: what it shows and commands; running or not.
        robot: whose shapes to draw.
    """

    def __init__(self, server: viser.ViserServer, session: Session, robot: RobotDescription) -> None:
        self._server, self._session = server, session
        self._loop = LoopThread("surefoot-page", self._draw, level=SHOWS)
        self._clock, self.frames = FrameClock(), 0
        self._set_theme(False)
        self._speakers = ClientGuard(server)
        self.driver_lock = DriverLock(session.send, current_client)
        self._speakers.accepts = self.driver_lock.accepts
        self._grip = Grip(server, self.driver_lock.send)
        self._scene = SceneView(server, robot, send=self.driver_lock.send, let_drag=self._grip.let_drag)
        self._overlays = Overlays(server)
        self._twin_scene = TwinScene(server, robot)
        self.shown: Snapshot = session.snapshot
        self._robot = robot
        self._preview = Preview(server)
        self._build()

    def start(self) -> None:
        """Start the thread that updates the page."""
        self._clock = FrameClock()
        self._loop.start()

    def stop(self) -> None:
        """Stop it and wait."""
        self._loop.stop()

    @property
    def statistics(self) -> PageStatistics:
        """How often the page is brought up to date."""
        return self._clock.statistics

    def _build(self) -> None:
        gui, send, first = self._server.gui, self.driver_lock.send, self._session.snapshot
        free = self._speakers.free
        entries = {name: entry.help for name, entry in controllers().items()}
        exhibits = gallery()
        scenarios = {exhibit.name: exhibit.text for group in exhibits.values() for exhibit in group}
        gui.set_panel_label("Surefoot")
        gui.main_panel.dock_right()
        gui.main_panel.set_width(_RIGHT_WIDTH)

        left = gui.add_panel()
        with left.add_tab("Balance", viser.Icon.SCALE):
            foot = FootPanel(gui, first)
            headroom = HeadroomPanel(gui, first)
            EventSteps(gui, send, lambda: self._session.snapshot)
            events = EventsPanel(gui, height=150)
        with left.add_tab("Plots", viser.Icon.CHART_LINE), free():
            plots = PlotsPanel(gui, first.limits, height=122)
        with left.add_tab("Twin", viser.Icon.USERS):
            self._twin = TwinPanel(gui, send, list(entries), first, ARRANGEMENTS, self._twin_scene.arrange)
        with left.add_tab("A/B", viser.Icon.ARROWS_LEFT_RIGHT):
            slots = SlotsPanel(gui, send, lambda: self._session.snapshot)
        with left.add_tab("Scenarios", viser.Icon.PHOTO):
            GalleryPanel(gui, send, exhibits)
        with left.add_tab("Export", viser.Icon.DOWNLOAD), free():
            keep = ExportPanel(
                gui, self._session.saved_run, page_address(self._server.get_host(), self._server.get_port())
            )
        with left.add_tab("Help", viser.Icon.HELP), free():
            again = gui.add_button(
                "Start the tour", hint="five steps: make the baseline fall, see the paper's law hold"
            )
            gui.add_markdown(help_text("start"))
            with gui.add_folder("Mouse, timeline, words", expand_by_default=False):
                gui.add_markdown(help_text("signs"))
            with gui.add_folder("Keyboard", expand_by_default=False):
                keys = KeysPanel(gui)
            add_guide(gui)
        left.dock_left()
        left.set_width(_LEFT_WIDTH)

        status = StatusPanel(gui, logo(), first)
        visitors = VisitorsPanel(self._server, self.driver_lock, gui.add_html("").order)
        run = RunPanel(gui, send, scenarios, first)
        timeline = TimelinePanel(gui, send, first)
        choice = ControllerPanel(gui, send, entries, first)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Disturb"):
            stones = StonesPanel(gui, lambda asked: send(self._twin_scene.placed(asked)), SOLE_PLACES)
            disturb = DisturbPanel(gui, send, first)
            repeat = RepeatSwitch(gui, send, first)
        with tabs.add_tab("Gains"):
            gains = GainsPanel(gui, send, lambda: self._session.snapshot, shipped_presets())
        with tabs.add_tab("Equations"):
            equations = EquationsPanel(gui, send, first)
        with tabs.add_tab("View"), free():
            CameraPanel(gui, (CAMERA_POSITION, CAMERA_LOOK_AT))
            LegendPanel(gui, self._show_marker, self._set_theme, self._scene.see_through, SEE_THROUGH)
        fall = FallPanel(gui, send)
        undo_keys(gui, send)
        suit_narrow_screens(self._server, (CAMERA_POSITION, CAMERA_LOOK_AT))
        aim_at = self._for_drivers(stones.aim_at)
        stones_on_click(self._server, stones.place_at, aim_at, lambda: self._session.snapshot.geometry.soles)
        tour = Tour(self._server, send, lambda: self._session.snapshot)
        again.on_click(lambda event: tour.start(event.client) if event.client is not None else None)
        self._plots, self._foot, self._next_stone = plots, foot, stones.wanted
        self._panels = (
            status, run, choice, stones, disturb, tour, keep, gains, equations, headroom, events, timeline, repeat,
            fall, self._twin, slots, visitors, keys,
        )  # fmt: skip

    def _for_drivers(self, aim: Callable[[Place], None]) -> Callable[[Place], None]:
        return lambda place: aim(place) if self.driver_lock.accepts(current_client()) else None

    def _show_marker(self, key: str, visible: bool) -> None:
        self._overlays.show(key, visible)
        self._twin_scene.show(key, visible)

    def _set_theme(self, dark: bool) -> None:
        self._server.gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)
        if hasattr(self, "_scene"):
            self._scene.set_dark(dark)

    def _draw(self) -> float:
        """A frame, and how long to wait for the next [s]."""
        started, frame = time.perf_counter(), self.frames
        self.frames += 1
        try:
            self._update(frame)
        except RuntimeError as error:
            if not _lost_a_race(error):
                raise
        return self._clock.drawn(started, FRAME_S)

    def _update(self, frame: int) -> None:
        snapshot = self._session.snapshot
        geometry = snapshot.geometry
        with self._server.atomic():
            self._overlays.update(geometry)
            self._twin_scene.update(snapshot)
            self._preview.update(aimed_stone(*self._next_stone(), snapshot, self._robot), geometry.stones)
            self._grip.update(geometry.pulls)
            self._scene.update(snapshot.geometry)  # last: it flushes, and both should be seen in one frame
        self._server.flush()
        self.shown = snapshot
        if frame % _PLOTS_EVERY == 0:
            self._plots.show(snapshot)
        if frame % _PLOTS_EVERY == 2:
            self._twin.plot(snapshot)
        if frame % _FOOT_EVERY == 1:
            self._foot.show(snapshot)
        if frame % _PANELS_EVERY == 3:
            for panel in self._panels:
                panel.show(snapshot)


def _lost_a_race(error: RuntimeError) -> bool:
    """Whether viser only failed to wake its event loop from this thread; the next frame does it."""
    return "mutated during iteration" in str(error)
