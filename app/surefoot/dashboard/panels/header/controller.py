"""Which controller is active."""

from typing import Literal

import viser

from surefoot.dashboard.messages.commands import SetController
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.synced_widget import SyncedWidget
from surefoot.dashboard.ui.widget_updates import set_changed

_KEYS: tuple[Literal["1", "2", "3", "4", "5", "6", "7", "8", "9"], ...] = ("1", "2", "3", "4", "5", "6", "7", "8", "9")


class ControllerPanel(Panel):
    """The dropdown and the keys 1 to 9.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        self._help = controllers = context.controllers
        keys = "; ".join(f"{i} = {name}" for i, name in enumerate(list(controllers)[: len(_KEYS)], start=1))
        self._choice = gui.add_dropdown(
            "Controller", list(controllers), initial_value=first.controller,
            hint=f"Who decides the torques; a switch fades over 50 ms. Keys: {keys}",
        )  # fmt: skip
        self._line, self._follower = gui.add_markdown(self._text(first.controller)), SyncedWidget(self._choice)

        @self._choice.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(SetController(event.target.value))

        for key, name in zip(_KEYS, controllers, strict=False):
            command = gui.add_command(f"Controller {name}", description=controllers[name], hotkey=key)
            command.on_trigger(lambda _, chosen=name: send(SetController(chosen)))

    def show(self, snapshot: Snapshot) -> None:
        """Take over which controller is active."""
        self._follower.show(snapshot.controller)
        set_changed(self._line, content=self._text(snapshot.controller))

    def _text(self, name: str) -> str:
        return f"<small>{self._help.get(name, '')}</small>"
