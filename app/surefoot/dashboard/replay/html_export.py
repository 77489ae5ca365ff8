"""A run as one HTML page that opens from disk: made with viser's own recorder, scene only, no plots or panels."""

import contextlib
import io
import secrets
from collections.abc import Callable

from surefoot.dashboard.access.gate import Gate
from surefoot.dashboard.access.guarded_server import guarded_server
from surefoot.dashboard.messages.shown_robot import view_scale
from surefoot.dashboard.replay.events import EventCaption
from surefoot.dashboard.replay.frames import ReplayFrames
from surefoot.dashboard.replay.treadmill import Treadmill
from surefoot.dashboard.scene.force_arrow import ForceArrow
from surefoot.dashboard.scene.markers.markers import Markers
from surefoot.dashboard.scene.scene import SceneView
from surefoot.experiments.runs.saved_run import SavedRun

FRAMES_PER_SECOND = 25


def replay_html(run: SavedRun, progress: Callable[[float], None] | None = None) -> str:
    """The page.

    Viser records what a server would send; this one listens on this machine only, behind a token that nobody has.

    Args:
        run: what to show.
        progress: called now and then with the part done, 0 to 1.

    Raises:
        InvalidInput: the run cannot be drawn.
    """
    frames = ReplayFrames(run)
    with contextlib.redirect_stdout(io.StringIO()):
        server = guarded_server("127.0.0.1", 0, Gate(secrets.token_hex(16)))
    try:
        scene, markers = SceneView(server, frames.robot), Markers(server, frames.robot)
        scene.show_terrain(frames.world.terrain)
        treadmill = Treadmill(scene, markers)
        force = ForceArrow(server, frames.robot)
        caption = EventCaption(server, run, view_scale(frames.robot))
        recorder = server.get_scene_serializer()
        first, last = float(frames.time_s[0]), float(frames.time_s[-1])
        count = max(1, round((last - first) * FRAMES_PER_SECOND))
        for i in range(count + 1):
            row = frames.row_at(first + i / FRAMES_PER_SECOND)
            geometry = frames.geometry(row)
            treadmill.follow(geometry.com[:2])
            markers.update(geometry)
            scene.update(geometry)
            force.update(frames.world.force(row))
            caption.update(float(frames.time_s[row]))
            recorder.insert_sleep(1.0 / FRAMES_PER_SECOND)
            if progress and i % 10 == 0:
                progress(i / count)
        return recorder.as_html()
    finally:
        with contextlib.redirect_stdout(io.StringIO()):
            server.stop()
