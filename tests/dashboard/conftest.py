"""A stage to drive by hand, and a dashboard on a port of its own."""

import pytest

from surefoot.dashboard.serve import start_dashboard
from surefoot.dashboard.stage import Stage


@pytest.fixture
def stage() -> Stage:
    return Stage("stand_left", "two-part")


@pytest.fixture(scope="module")
def dashboard():
    running = start_dashboard(port=0)
    yield running
    running.stop()
