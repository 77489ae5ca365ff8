"""A page that is loaded again and again, in a real browser."""

import pytest

from surefoot.dashboard.messages.commands import Pause
from surefoot.dashboard.page import FRAME_S
from tests.browser.leftovers import megabytes, threads

pytestmark = [pytest.mark.browser, pytest.mark.slow]

RELOADS, AT_FIRST, GROWTH_MB = 100, 10, 20.0


@pytest.fixture
def frame_s():
    """The page's own rate."""
    return FRAME_S


def test_a_hundred_reloads_leave_nothing_behind(screen):
    screen.dashboard.session.send(Pause())
    before, memory = threads(), 0.0
    for number in range(RELOADS):
        if number == AT_FIRST:
            memory = megabytes()
        screen.open()
    screen.wait_for(lambda: len(screen.dashboard.server.get_clients()) == 1)
    assert threads() <= before
    assert megabytes() - memory < GROWTH_MB
