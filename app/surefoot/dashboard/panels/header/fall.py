"""What appears when Bip has fallen: why, the way back to where it began, and the way to the start."""

from collections.abc import Callable

import viser

from surefoot.dashboard.messages.commands import Reset, Seek
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.ui.setting_widgets import Send
from surefoot.dashboard.ui.widget_updates import set_changed

_BEFORE_S = 0.5
_BEFORE, _FIRST_LIMIT = "Go to 0.5 s before the fall", "Go to the first limit passed"


class FallPanel(Panel):
    """A panel over the scene, hidden while Bip stands.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send = context.gui, context.send
        self._panel = gui.add_panel(visible=False)
        with self._panel.add_tab("Bip has fallen", viser.Icon.ALERT_TRIANGLE):
            self._text = gui.add_markdown("")
            before = gui.add_button(_BEFORE, hint="go back and look; a change made there forks the run")
            self._limit = gui.add_button(_FIRST_LIMIT, hint="go to where the trouble began")
            again = gui.add_button("Reset and try again", color="orange", hint="key: R")
        self._panel.float(x=15, y=-15, width=340)  # below, the tour is above
        self._snapshot: Snapshot | None = None
        before.on_click(lambda _: self._go(send, _fall_s, _BEFORE_S))
        self._limit.on_click(lambda _: self._go(send, _limit_s, 0.0))
        again.on_click(lambda _: send(Reset()))

    def show(self, snapshot: Snapshot) -> None:
        """Appear or disappear."""
        self._snapshot, verdict = snapshot, snapshot.verdict
        set_changed(self._limit, visible=verdict.first_limit_s is not None)
        if verdict.fall_text:
            set_changed(self._text, content=verdict.fall_text)
        set_changed(self._panel, visible=bool(verdict.fall_cause))

    def _go(self, send: Send, when: Callable[[Snapshot], float | None], before_s: float) -> None:
        """Seek, no further back than is kept."""
        snapshot = self._snapshot
        time_s = when(snapshot) if snapshot else None
        if snapshot and time_s is not None:
            send(Seek(max(time_s - before_s, snapshot.timeline.oldest_s)))


def _fall_s(snapshot: Snapshot) -> float | None:
    return snapshot.verdict.fall_time_s


def _limit_s(snapshot: Snapshot) -> float | None:
    return snapshot.verdict.first_limit_s
