"""What appears when Bip has fallen: why, and the way back."""

import viser

from app.dashboard.commands import Reset
from app.dashboard.panels.fields import Send
from app.dashboard.snapshot import Snapshot


class FallPanel:
    """A panel over the scene, hidden while Bip stands.

    Args:
        gui: where to add it.
        send: takes the commands.
    """

    def __init__(self, gui: viser.GuiApi, send: Send) -> None:
        self._panel = gui.add_panel(visible=False)
        with self._panel.add_tab("Bip has fallen", viser.Icon.ALERT_TRIANGLE):
            self._text = gui.add_markdown("")
            again = gui.add_button("Reset and try again", color="orange", hint="key: R")
        self._panel.float(x=20, y=20, width=340)
        again.on_click(lambda _: send(Reset()))

    def show(self, snapshot: Snapshot) -> None:
        """Appear or disappear."""
        verdict = snapshot.verdict
        if verdict.fall_text and self._text.content != verdict.fall_text:
            self._text.content = verdict.fall_text
        if self._panel.visible != bool(verdict.fall_cause):
            self._panel.visible = bool(verdict.fall_cause)
