"""The page: panels and views around one session, and the thread that keeps them up to date."""

import time
from collections.abc import Callable

import numpy as np
import viser

from surefoot.control.registry import controllers, unavailable_controllers
from surefoot.dashboard.access.client_context import ClientGuard, current_client
from surefoot.dashboard.access.driver_lock import DriverLock
from surefoot.dashboard.access.paced_messages import PacedMessages
from surefoot.dashboard.access.ports import page_address
from surefoot.dashboard.engine.frame_clock import FrameClock, PageStatistics
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.engine.threads import SHOWS, LoopThread
from surefoot.dashboard.messages.shown_robot import robot_choices, view_scale
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.balance.events import EventsPanel, add_event_steps
from surefoot.dashboard.panels.balance.foot import FootPanel
from surefoot.dashboard.panels.balance.limits import HeadroomPanel
from surefoot.dashboard.panels.compare.ab_slots import SlotsPanel
from surefoot.dashboard.panels.disturb.disturb import DisturbPanel
from surefoot.dashboard.panels.disturb.stones import StonesPanel, aimed_stone
from surefoot.dashboard.panels.export.export import ExportPanel
from surefoot.dashboard.panels.header.run import ControllerPanel, RunPanel
from surefoot.dashboard.panels.header.status import FallPanel, StatusPanel
from surefoot.dashboard.panels.header.timeline import RepeatSwitch, TimelinePanel
from surefoot.dashboard.panels.header.visitors import VisitorsPanel
from surefoot.dashboard.panels.help.guide import add_first_words, add_guide
from surefoot.dashboard.panels.help.keys import KeysPanel
from surefoot.dashboard.panels.help.tour import Tour
from surefoot.dashboard.panels.panel import TABS_STYLE, PageContext, Panel, Tab, add_contents, add_tabs, due
from surefoot.dashboard.panels.plots.plots import PlotsPanel
from surefoot.dashboard.panels.scenarios.gallery import GalleryPanel
from surefoot.dashboard.panels.sensors.plant import PlantPanel
from surefoot.dashboard.panels.sensors.sensors import SensorsPanel
from surefoot.dashboard.panels.tuning.gains import EquationsPanel, GainsPanel
from surefoot.dashboard.panels.tuning.undo import add_undo_keys
from surefoot.dashboard.panels.twin.twin import TwinPanel, TwinSettingsPanel
from surefoot.dashboard.panels.twin.twin_plots import TwinPlotsPanel
from surefoot.dashboard.panels.view.camera import add_camera
from surefoot.dashboard.panels.view.legend import LegendPanel
from surefoot.dashboard.panels.walk.walk import WalkPanel
from surefoot.dashboard.scene.cameras import Cameras
from surefoot.dashboard.scene.click_to_place import Place, stones_on_click
from surefoot.dashboard.scene.drag_pull import Grip
from surefoot.dashboard.scene.markers.believed import BelievedMarker
from surefoot.dashboard.scene.markers.markers import Markers
from surefoot.dashboard.scene.scene import SceneView
from surefoot.dashboard.scene.stone_preview import Preview
from surefoot.dashboard.scene.twin_scene import TwinScene
from surefoot.dashboard.ui.mobile_layout import STYLE
from surefoot.experiments.scenario.robots import robot_named
from surefoot.robot.description import RobotDescription

FRAME_S = 1.0 / 60.0
_LEFT_WIDTH, _RIGHT_WIDTH = 330, 330

LEFT_TABS = (
    Tab("Balance", viser.Icon.SCALE, (FootPanel, HeadroomPanel, add_event_steps, EventsPanel)),
    Tab("Plots", viser.Icon.CHART_LINE, (PlotsPanel,), free=True),
    Tab("Twin", viser.Icon.USERS, (TwinPanel, TwinPlotsPanel, TwinSettingsPanel)),
    Tab("A/B", viser.Icon.ARROWS_LEFT_RIGHT, (SlotsPanel,)),
    Tab("Scenarios", viser.Icon.PHOTO, (GalleryPanel,)),
    Tab("Export", viser.Icon.DOWNLOAD, (ExportPanel,), free=True),
    Tab("Help", viser.Icon.HELP, (Tour, add_first_words, KeysPanel, add_guide), free=True),
)
HEADER = (StatusPanel, VisitorsPanel, RunPanel, TimelinePanel, ControllerPanel)
RIGHT_TABS = (
    Tab("Disturb", None, (StonesPanel, DisturbPanel, RepeatSwitch)),
    Tab("Walk", None, (WalkPanel,)),
    Tab("Gains", None, (GainsPanel,)),
    Tab("Equations", None, (EquationsPanel,)),
    Tab("Sensors", None, (SensorsPanel, PlantPanel)),
    Tab("View", None, (add_camera, LegendPanel), free=True),
)
BESIDE_THE_TABS = (FallPanel, add_undo_keys)  # cards over the scene, and keys


class Page:
    """Everything in the browser.

    Args:
        server: viser's server, still empty.
        session: what it shows and commands; running or not.
        robot: whose shapes to draw.
        paces: what each browser is sent.
    """

    def __init__(
        self, server: viser.ViserServer, session: Session, robot: RobotDescription, paces: PacedMessages
    ) -> None:
        self._server, self._session = server, session
        self._loop = LoopThread("surefoot-page", self._draw, level=SHOWS)
        self._clock, self.frames = FrameClock(), 0
        self._set_theme(False)
        self._client_guard = ClientGuard(server)
        self.driver_lock = DriverLock(session.send, current_client)
        self._client_guard.accepts = self.driver_lock.accepts
        self._grip = Grip(server, self.driver_lock.send, robot)
        self._scene = SceneView(server, robot, send=self.driver_lock.send, let_drag=self._grip.let_drag)
        self._markers = Markers(server, robot)
        self._cameras = Cameras(server, paces.rest_s)
        self._twin_scene = TwinScene(server, robot, self._cameras.look_from)
        self.shown: Snapshot = session.snapshot
        self._robot, self.paces = robot, paces
        self._robot_key = self.shown.robot.key
        self._cameras.suit(view_scale(robot))
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

    def _context(self) -> PageContext:
        server, session, send = self._server, self._session, self.driver_lock.send
        return PageContext(
            server=server,
            gui=server.gui,
            cameras=self._cameras,
            show_marker=self._show_marker,
            set_dark=self._set_theme,
            see_through=self._scene.see_through,
            address=page_address(server.get_host(), server.get_port()),
            send=send,
            send_stone=lambda command: send(self._twin_scene.placed(command)),
            newest=lambda: session.snapshot,
            saved_run=session.saved_run,
            free=self._client_guard.free,
            driver_lock=self.driver_lock,
            robots=robot_choices(self.shown.robot),
            controllers={name: entry.help for name, entry in controllers().items()},
            unavailable_controllers=unavailable_controllers(),
            arrange_twin=self._twin_scene.arrange,
            twin_arrangement=lambda: self._twin_scene.arrangement,
        )

    def _build(self) -> None:
        gui, context = self._server.gui, self._context()
        gui.set_panel_label("Surefoot")
        gui.main_panel.dock_right()
        gui.main_panel.set_width(_RIGHT_WIDTH)
        left = gui.add_panel()
        made = add_tabs(left, LEFT_TABS, context)
        for tab in left._tab_handles:
            self.paces.watch(tab._label, tab)
        left.dock_left()
        left.set_width(_LEFT_WIDTH)
        made += add_contents(HEADER, context)
        made += add_tabs(gui.add_tab_group(), RIGHT_TABS, context)
        made += add_contents(BESIDE_THE_TABS, context)
        self._panels = [panel for panel in made if isinstance(panel, Panel)]
        gui.add_html(STYLE + TABS_STYLE)
        stones = next(panel for panel in made if isinstance(panel, StonesPanel))  # it says what the scene previews
        self._next_stone = stones.wanted
        aim_at = self._for_drivers(stones.aim_at)
        stones_on_click(self._server, stones.place_at, aim_at, lambda: self._session.snapshot.geometry.soles)

    def _for_drivers(self, aim: Callable[[Place], None]) -> Callable[[Place], None]:
        return lambda place: aim(place) if self.driver_lock.accepts(current_client()) else None

    def _change_robot(self, key: str) -> None:
        self._robot, self._robot_key = robot_named(key), key
        for part in (self._scene, self._markers, self._twin_scene, self._grip):
            part.change_robot(self._robot)
        self._cameras.suit(view_scale(self._robot))

    def _show_marker(self, key: str, visible: bool) -> None:
        self._markers.show(key, visible)
        if key == BelievedMarker.key:
            self._scene.show_believed(visible)
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
        if snapshot.robot.key != self._robot_key:
            self._change_robot(snapshot.robot.key)
        with self._server.atomic():
            self._markers.update(geometry)
            self._twin_scene.update(snapshot)
            self._preview.update(aimed_stone(*self._next_stone(), snapshot, self._robot), geometry.stones)
            self._grip.update(geometry.pulls)
            self._scene.show_terrain(snapshot.terrain)
            self._scene.update(snapshot.geometry)  # last: it flushes, and both should be seen in one frame
        self._server.flush()
        self._cameras.update(_to_follow(snapshot), snapshot.run)
        self.shown = snapshot
        for panel in due(self._panels, frame):
            panel.show(snapshot)


def _to_follow(snapshot: Snapshot) -> np.ndarray:
    """Centre of mass (3,) [m] of the robot that cameras follow: the first, or its twin where that alone still walks."""
    twin = snapshot.twin.other if snapshot.twin else None
    if twin is not None and snapshot.balance.fall_cause is not None and twin.balance.fall_cause is None:
        return twin.geometry.com
    return snapshot.geometry.com


def _lost_a_race(error: RuntimeError) -> bool:
    """Whether viser only failed to wake its event loop from this thread; the next frame does it."""
    return "mutated during iteration" in str(error)
