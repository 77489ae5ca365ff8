"""What a panel is given: where to add its widgets, where to send commands, and what else of the page it may use."""

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from contextlib import AbstractContextManager
from dataclasses import dataclass

import viser

from surefoot.dashboard.access.driver_lock import DriverLock
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.ui.setting_widgets import Send
from surefoot.experiments.runs.saved_run import SavedRun


@dataclass(frozen=True)
class ViewContext:
    """What the panels of any page with a 3D scene need, of a replay too.

    Attributes:
        gui: where to add widgets (into the current container).
        show_marker: shows or hides a marker: its key, and whether it is visible.
        set_dark: makes the page dark or light.
        see_through: makes one of ``SEE_THROUGH`` see-through.
    """

    gui: viser.GuiApi
    show_marker: Callable[[str, bool], None]
    set_dark: Callable[[bool], None]
    see_through: Callable[[str], None]


@dataclass(frozen=True)
class PageContext(ViewContext):
    """What the panels of the page of a live run need besides.

    Attributes:
        server: whose clients come and go.
        address: of the page, without a query.
        send: takes the commands of whoever may drive.
        send_stone: the same, for stones: one clicked at the twin beside the first robot is meant for the first's place.
        newest: gives the newest snapshot.
        saved_run: asks for the last seconds of the run as data.
        free: widgets made in this context may be moved by who does not drive, too.
        driver_lock: who drives.
        controllers: name -> one line of help.
        arrange_twin: takes one of ``ARRANGEMENTS``, and who asked.
    """

    server: viser.ViserServer
    address: str
    send: Send
    send_stone: Send
    newest: Callable[[], Snapshot]
    saved_run: Callable[[], Future[SavedRun]]
    free: Callable[[], AbstractContextManager[None]]
    driver_lock: DriverLock
    controllers: Mapping[str, str]
    arrange_twin: Callable[[str, viser.ClientHandle | None], None]
