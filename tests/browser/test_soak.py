"""Five visitors who do anything at all for an hour: no exception, no NaN, no thread and no memory is left behind.

``SUREFOOT_SOAK_MINUTES=60 ./scripts/test -m slow tests/browser/test_soak.py``: 3,000 actions in an hour at least, more
where there is time for them; fewer minutes, fewer actions. What was measured is in ``artefacts/soak.json``.
"""

import json
import os
import time

import pytest

from surefoot.dashboard.launch import start_dashboard
from tests.browser.conftest import ARTEFACTS, PATIENCE_MS, TOUR_SEEN, Screen
from tests.browser.leftovers import FULL_PAST_S, GROWTH_MB, WARM_UP, complaints, finite, megabytes, settle, threads
from tests.browser.monkey import Monkey

pytestmark = [pytest.mark.browser, pytest.mark.slow]

MINUTES = float(os.environ.get("SUREFOOT_SOAK_MINUTES", "0"))
VISITORS, ACTIONS_PER_MINUTE = 5, 50
# Only the first page is drawn in 3D, so that a machine without a GPU has a core left for the program.
WITHOUT_3D = """
const getContext = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
};"""


@pytest.fixture
def crowd(chromium):
    """The screens of all visitors of one dashboard."""
    dashboard, screens = start_dashboard(port=0), []
    for number in range(VISITORS):
        context = chromium.new_context(viewport={"width": 1000, "height": 640})
        context.add_init_script(TOUR_SEEN if number == 0 else f"{TOUR_SEEN};{WITHOUT_3D}")
        page = context.new_page()
        page.set_default_timeout(PATIENCE_MS)
        screens.append(Screen(page, dashboard))
        screens[-1].open()
    yield screens
    for screen in screens:
        screen.page.context.close()
    dashboard.stop()


class Soak:
    """What is done and measured; the file is there from the first minute on.

    Args:
        screens: of the visitors.
    """

    def __init__(self, screens: list[Screen]) -> None:
        self.session, self._screens = screens[0].dashboard.session, screens
        self.mishaps: list[str] = []
        for number, screen in enumerate(screens):
            screen.page.on("pageerror", lambda error, number=number: self.mishaps.append(f"page {number}: {error}"))
        self._monkeys = [Monkey(screen, 3 + number) for number, screen in enumerate(screens)]
        self.actions, self._began = 0, time.monotonic()
        self.record: list[dict] = []
        self.settled: dict[str, float] = {}  # minute -> resident memory [MB], with nothing going on
        self.terminal: list[str] = []

    def minutes(self) -> float:
        """Since the beginning."""
        return (time.monotonic() - self._began) / 60.0

    def act(self) -> None:
        """One action of the next visitor; once a minute it is noted how things stand."""
        monkey = self._monkeys[self.actions % VISITORS]
        monkey.act()
        self.actions += 1
        assert finite(self.session.snapshot), monkey.done[-3:]
        assert self.session.statistics().errors == 0, monkey.done[-3:]
        if len(self.record) < self.minutes():
            self.note()

    def settle(self) -> None:
        """Let everything come to rest, and measure."""
        settle(self._screens[0], FULL_PAST_S, [action for monkey in self._monkeys for action in monkey.done[-3:]])
        self.settled[f"{self.minutes():.1f}"] = round(megabytes(), 1)
        self.note()

    def note(self) -> None:
        """Write down how things stand."""
        self.record.append({
            "minute": round(self.minutes(), 1),
            "actions": self.actions,
            "memory_mb": round(megabytes(), 1),
            "threads": len(threads()),
            "visitors": len(self._screens[0].dashboard.server.get_clients()),
            "real_time_factor": round(self.session.statistics().real_time_factor, 2),
        })  # fmt: skip
        found = {
            "minutes": round(self.minutes(), 1),
            "actions": self.actions,
            "settled_memory_mb": self.settled,
            "errors": [*self.mishaps, *self.terminal],
            "record": self.record,
        }
        ARTEFACTS.mkdir(parents=True, exist_ok=True)
        (ARTEFACTS / "soak.json").write_text(json.dumps(found, indent=1) + "\n")


@pytest.mark.skipif(MINUTES <= 0.0, reason="SUREFOOT_SOAK_MINUTES says for how long")
def test_an_hour_of_five_visitors_leaves_nothing_behind(crowd, capfd):
    soak, before = Soak(crowd), threads()
    while soak.minutes() < MINUTES or soak.actions < ACTIONS_PER_MINUTE * MINUTES:
        soak.act()
        if not soak.settled and soak.minutes() >= MINUTES / 6.0 and soak.actions >= WARM_UP:
            soak.settle()
    soak.settle()
    soak.terminal = complaints("".join(capfd.readouterr()))
    soak.note()
    assert soak.mishaps == soak.terminal == []
    assert threads() <= before
    memory = list(soak.settled.values())  # a short soak has one value only
    assert memory[-1] - memory[0] < GROWTH_MB
