"""Random actions in a real browser leave no exception, no NaN, no thread and no memory behind."""

import pytest

from surefoot.dashboard.page import FRAME_S
from tests.browser.leftovers import FULL_PAST_S, GROWTH_MB, WARM_UP, complaints, finite, megabytes, settle, threads
from tests.browser.monkey import Monkey

pytestmark = pytest.mark.browser


@pytest.fixture
def frame_s():
    """The page's own rate: whatever random actions find, they find it sooner."""
    return FRAME_S


@pytest.mark.parametrize(("actions", "seed"), [
    pytest.param(40, 1, id="some"), pytest.param(1000, 2, id="thousand", marks=pytest.mark.slow),
])  # fmt: skip
def test_random_actions_leave_nothing_behind(screen, actions, seed, capfd):
    session, mishaps, monkey = screen.dashboard.session, [], Monkey(screen, seed)
    screen.page.on("pageerror", lambda error: mishaps.append(str(error)))
    before, memory = threads(), None
    while len(monkey.done) < actions:
        monkey.act()
        assert finite(session.snapshot), monkey.done[-3:]
        assert session.statistics().errors == 0, monkey.done[-3:]
        if len(monkey.done) == WARM_UP:
            settle(screen, FULL_PAST_S, monkey.done)
            memory = megabytes()
    settle(screen, 0.2 if memory is None else FULL_PAST_S, monkey.done)
    grown = megabytes() - memory if memory is not None else 0.0
    mishaps.extend(complaints("".join(capfd.readouterr())))
    print(f"{len(monkey.done)} actions: {grown:+.1f} MB; {len(threads())} threads of {len(before)} at first; {mishaps}")
    assert mishaps == []
    assert threads() <= before
    assert grown < GROWTH_MB
