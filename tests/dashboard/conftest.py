"""A stage to drive by hand, and a dashboard on a port of its own."""

import pytest

from surefoot.dashboard.launch import start_dashboard
from surefoot.dashboard.live.live_run import Stage


@pytest.fixture
def stage() -> Stage:
    return Stage("stand_left", "two-part")


@pytest.fixture(scope="module")
def dashboard():
    running = start_dashboard(port=0)
    yield running
    running.stop()
