"""What a page is made of: panels that are brought up to date, the tabs in which they stand, and what they are given."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Future
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass

import viser

from surefoot.dashboard.access.driver_lock import DriverLock
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.scene.cameras import Cameras
from surefoot.dashboard.ui.setting_widgets import Send
from surefoot.experiments.runs.saved_run import SavedRun


@dataclass(frozen=True)
class ViewContext:
    """What the panels of any page with a 3D scene need, of a replay too.

    Attributes:
        server: whose clients come and go.
        gui: where to add widgets (into the current container).
        cameras: where everybody looks from.
        show_marker: shows or hides a marker: its key, and whether it is visible.
        set_dark: makes the page dark or light.
        see_through: makes one of ``SEE_THROUGH`` see-through.
    """

    server: viser.ViserServer
    gui: viser.GuiApi
    cameras: Cameras
    show_marker: Callable[[str, bool], None]
    set_dark: Callable[[bool], None]
    see_through: Callable[[str], None]


@dataclass(frozen=True)
class PageContext(ViewContext):
    """What the panels of the page of a live run need besides.

    Attributes:
        address: of the page, without a query.
        send: takes the commands of whoever may drive.
        send_stone: the same, for stones: one clicked at the twin beside the first robot is meant for the first's place.
        newest: gives the newest snapshot.
        saved_run: asks for the last seconds of the run as data.
        free: widgets made in this context may be moved by who does not drive, too.
        driver_lock: who drives.
        robots: title -> key of those that can be chosen.
        controllers: name -> one line of help.
        unavailable_controllers: name -> why it cannot be used.
        arrange_twin: takes one of ``ARRANGEMENTS``, and who asked.
        twin_arrangement: gives the one active.
    """

    address: str
    send: Send
    send_stone: Send
    newest: Callable[[], Snapshot]
    saved_run: Callable[[], Future[SavedRun]]
    free: Callable[[], AbstractContextManager[None]]
    driver_lock: DriverLock
    robots: Mapping[str, str]
    controllers: Mapping[str, str]
    unavailable_controllers: Mapping[str, str]
    arrange_twin: Callable[[str, viser.ClientHandle | None], None]
    twin_arrangement: Callable[[], str]


# viser pads a tab by 0.9em: six of them took two rows
TABS_STYLE = """<style>[role="tab"][style*="0.9em"] { padding: 0 0.4em !important; }</style>"""

Content = Callable[[PageContext], object]  # adds widgets to the current container; a panel's class, or a function


class Panel(ABC):
    """A part of the page that shows how things stand.

    Attributes:
        every_frames: how often it is shown a snapshot.
    """

    every_frames: int = 10

    @abstractmethod
    def show(self, snapshot: Snapshot) -> None:
        """Take over how things stand.

        Args:
            snapshot: the newest one.
        """


@dataclass(frozen=True)
class Tab:
    """One tab.

    Attributes:
        label: its title.
        icon: beside the title.
        contents: from top to bottom.
        free: whoever does not drive may move its widgets, too.
    """

    label: str
    icon: viser.IconName | None
    contents: tuple[Content, ...]
    free: bool = False


def add_contents(contents: Iterable[Content], context: PageContext) -> list[object]:
    """Add them to the current container, from top to bottom; returns what each has made."""
    return [content(context) for content in contents]


def add_tabs(
    group: viser.PanelHandle | viser.GuiTabGroupHandle, tabs: Iterable[Tab], context: PageContext
) -> list[object]:
    """Add tabs and all that is in them.

    Args:
        group: where to add them.
        tabs: from left to right.
        context: what the contents are given.

    Returns:
        What each content has made.
    """
    made: list[object] = []
    for tab in tabs:
        with group.add_tab(tab.label, tab.icon), context.free() if tab.free else nullcontext():
            made += add_contents(tab.contents, context)
    return made


def due(panels: list[Panel], frame: int) -> list[Panel]:
    """The panels to be shown a snapshot in a frame: neighbours take turns, so that no frame has to draw them all."""
    return [panel for number, panel in enumerate(panels) if (frame - number) % panel.every_frames == 0]
