"""``surefoot replay``: a saved run as a page in which one plays, pauses and scrubs."""

import contextlib
import io
import signal
import sys
import threading
import time
from collections.abc import Iterable
from html import escape
from pathlib import Path

import numpy as np
import viser

from surefoot.dashboard.access.gate import Gate, check_listening
from surefoot.dashboard.access.guarded_server import guarded_server
from surefoot.dashboard.access.origins import allowed_origins
from surefoot.dashboard.access.ports import free_port, page_address, printed_address
from surefoot.dashboard.engine.threads import LoopThread
from surefoot.dashboard.messages.shown_robot import view_scale
from surefoot.dashboard.panels.panel import ViewContext
from surefoot.dashboard.panels.view.camera import add_camera
from surefoot.dashboard.panels.view.legend import LegendPanel
from surefoot.dashboard.replay.events import events_html
from surefoot.dashboard.replay.frames import ReplayFrames
from surefoot.dashboard.scene.cameras import Cameras
from surefoot.dashboard.scene.force_arrow import ForceArrow
from surefoot.dashboard.scene.markers.believed import BelievedMarker
from surefoot.dashboard.scene.markers.markers import Markers
from surefoot.dashboard.scene.scene import SceneView
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.sliders import add_slider
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.experiments.runs.robot_files import robot_note, with_robot
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.saved_run import SavedRun, imperfection_note, interruption

_FRAME_S = 1.0 / 40.0
_LONGEST_FRAME_S = 0.5  # what takes longer is a machine asleep or a program stopped, and no time of the run
_SLIDER_EVERY = 6  # frames


class ReplayPage:
    """The page of one saved run.

    Args:
        server: viser's server, still empty.
        run: what to show.

    Attributes:
        time_s: of the run, what is shown now.
        playing: whether it goes on by itself.
    """

    def __init__(self, server: viser.ViserServer, run: SavedRun) -> None:
        self._server, self._frames, self._run = server, ReplayFrames(run), run
        self._first, self._last = float(self._frames.time_s[0]), float(self._frames.time_s[-1])
        self.time_s, self.playing, self._speed = self._first, True, 1.0
        self._row, self._robot = -1, np.zeros(3)
        self._frame, self._before = 0, time.perf_counter()
        self._loop = LoopThread("surefoot-replay", self._follow)
        self._theme(False)
        self._scene, self._markers = SceneView(server, self._frames.robot), Markers(server, self._frames.robot)
        self._scene.show_terrain(self._frames.world.terrain)
        self._force, self._cameras = ForceArrow(server, self._frames.robot), Cameras(server)
        self._cameras.suit(view_scale(self._frames.robot))
        self._build()

    def start(self) -> None:
        """Start the thread that plays."""
        self._before = time.perf_counter()
        self._loop.start()

    def stop(self) -> None:
        """Stop it and wait."""
        self._loop.stop()

    def _build(self) -> None:
        gui, manifest = self._server.gui, self._run.manifest
        view = ViewContext(self._server, gui, self._cameras, self._show, self._theme, self._scene.see_through)
        gui.set_panel_label("Surefoot replay")
        gui.add_markdown(
            f"**{escape(str(manifest['scenario_name']))}** under **{escape(str(manifest['controller']))}**\n\n"
            f"<small>{len(self._frames)} ticks, commit {escape(str(manifest['git_commit']))[:12]}</small>\n\n"
            f"{escape(imperfection_note(manifest) or '')}\n\n"
            f"{interruption(manifest) or ''}\n\n{escape(robot_note(manifest) or '')}"
        )
        play = gui.add_button("Play / pause", hint="key: space")
        self._slider = add_slider(
            gui, "Time [s]", self._first, max(self._last, self._first + 1e-3), 0.001, self._first, hint="scrub"
        )
        self._written = self._slider.value
        speed = add_slider(gui, "Speed [×]", 0.1, 2.0, 0.1, 1.0, hint="seconds of the run per second")
        self._story = gui.add_html("")
        with gui.add_folder("View", expand_by_default=False):
            add_camera(view)
            LegendPanel(view)

        play.on_click(lambda _: self._toggle())
        gui.add_command("Play / pause", hotkey="space").on_trigger(lambda _: self._toggle())

        @self._slider.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                self._scrub(event.target.value)

        @speed.on_update
        def _(event: viser.GuiEvent) -> None:
            self._speed = float(event.target.value)

    def _show(self, key: str, visible: bool) -> None:
        self._markers.show(key, visible)
        if key == BelievedMarker.key:
            self._scene.show_believed(visible)

    def _scrub(self, time_s: float) -> None:
        self.playing, self.time_s = False, float(time_s)

    def _theme(self, dark: bool) -> None:
        self._server.gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)
        if hasattr(self, "_scene"):
            self._scene.set_dark(dark)

    def _toggle(self) -> None:
        if not self.playing and self.time_s >= self._last:
            self.time_s = self._first
        self.playing = not self.playing

    def _follow(self) -> float:
        """Go on and draw; returns how long to wait for the next frame [s]."""
        now = time.perf_counter()
        if self.playing:
            self.time_s = min(self._last, self.time_s + min(now - self._before, _LONGEST_FRAME_S) * self._speed)
            self.playing = self.time_s < self._last
        self._before, self._frame = now, self._frame + 1
        self._draw(self._frame - 1)
        return _FRAME_S - (time.perf_counter() - now)

    def _draw(self, frame: int) -> None:
        row = self._frames.row_at(self.time_s)
        if row != self._row:
            self._row, geometry = row, self._frames.geometry(row)
            self._robot = geometry.com
            with self._server.atomic():
                self._markers.update(geometry)
                self._force.update(self._frames.world.force(row))
                self._scene.update(geometry)  # last: it flushes, and all should be seen in one frame
            self._server.flush()
        self._cameras.update(self._robot)
        if frame % _SLIDER_EVERY == 0 or not self.playing:
            if abs(self._slider.value - self._written) > 1e-9:  # a person's, whose callback waits for a free thread
                self._scrub(self._slider.value)
            if abs(self._slider.value - self.time_s) > 1e-9:
                self._slider.value = self.time_s
            self._written = self._slider.value
            set_changed(self._story, content=events_html(self._run, self.time_s))


def start_replay(
    run: SavedRun, *, host: str, port: int | None, token: str | None, allow_origin: Iterable[str] = ()
) -> tuple[str, ReplayPage, viser.ViserServer]:
    """Start the page; returns its address and its parts. Raises InvalidInput."""
    check_listening(host, token)
    gate = Gate(token, allowed_origins(allow_origin))
    with contextlib.redirect_stdout(io.StringIO()):
        server = guarded_server(host, free_port(host, port), gate)
    try:
        player = ReplayPage(server, run)
    except Exception:
        server.stop()
        raise
    player.start()
    return page_address(host, server.get_port(), token), player, server


def serve_replay(
    file: Path,
    *,
    robot: str | None = None,
    host: str,
    port: int | None,
    token: str | None,
    allow_origin: Iterable[str] = (),
) -> None:
    """Serve a saved run until Ctrl-C; ``robot``: where its robot's file lies now. Raises InvalidInput."""
    run = with_robot(read_run(file), robot)
    address, player, server = start_replay(run, host=host, port=port, token=token, allow_origin=allow_origin)
    stop = threading.Event()
    for name in (signal.SIGINT, signal.SIGTERM):
        signal.signal(name, lambda *_: stop.set())
    print(f"Surefoot replays {file.name}: open {printed_address(address)} (Ctrl-C stops it)", flush=True)
    for line in (interruption(run.manifest), robot_note(run.manifest)):
        if line:
            print(f"surefoot: {line}", file=sys.stderr)
    while not stop.wait(0.5):
        pass
    with contextlib.redirect_stdout(io.StringIO()):
        player.stop()
        server.stop()
    sys.stdout.flush()
