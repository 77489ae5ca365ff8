"""What a page is made of: panels that are brought up to date, and the tabs in which they stand."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from contextlib import nullcontext
from dataclasses import dataclass

import viser

from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext

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
