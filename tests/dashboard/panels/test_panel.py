"""The page is a list of panels: each is brought up to date at its own pace, and none is forgotten."""

import inspect
from collections import Counter

import pytest

from surefoot.dashboard import page
from surefoot.dashboard.panels.panel import Panel, due

TABS = (*page.LEFT_TABS, *page.RIGHT_TABS)
CONTENTS = [
    *(content for tab in TABS for content in tab.contents),
    *page.HEADER,
    *page.BESIDE_THE_TABS,
]


@pytest.mark.parametrize("content", CONTENTS, ids=lambda content: content.__name__)
def test_what_has_something_to_show_is_a_panel(content):
    assert not hasattr(content, "show") or (inspect.isclass(content) and issubclass(content, Panel))


def test_nothing_is_on_the_page_twice():
    assert max(Counter(CONTENTS).values()) == 1
    assert max(Counter(tab.label for tab in TABS).values()) == 1


class Paced(Panel):
    def __init__(self, every_frames):
        self.every_frames = every_frames

    def show(self, snapshot):
        """Nothing."""


def test_each_panel_has_its_pace_and_they_take_turns():
    panels = [Paced(10) for _ in range(10)] + [Paced(4), Paced(4)]
    shown = Counter(id(panel) for frame in range(40) for panel in due(panels, frame))
    assert [shown[id(panel)] for panel in panels] == [4] * 10 + [10, 10]
    assert max(len(due(panels, frame)) for frame in range(20)) == 2
