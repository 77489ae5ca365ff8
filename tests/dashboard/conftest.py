"""A live run to drive by hand, and a dashboard on a port of its own."""

import pytest
import viser

from surefoot.dashboard.launch import start_dashboard
from surefoot.dashboard.live.playback import Playback


@pytest.fixture
def playback() -> Playback:
    return Playback("stand_left", "two-part")


@pytest.fixture
def server():
    """A page's server, for a panel or a scene alone."""
    alone = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield alone
    alone.stop()


@pytest.fixture(scope="module")
def dashboard():
    running = start_dashboard(port=0)
    yield running
    running.stop()
