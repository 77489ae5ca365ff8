"""Who looks on and who drives: a line for each visitor, and who has control where only one drives at a time."""

import time
from typing import Literal

import viser

from surefoot.dashboard.access.driver_lock import EVERYBODY, ONE, DriverLock, DriverView
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.synced_widget import SyncedWidget, set_changed

_QUIET_S = 4.0  # between two refusals that a visitor is told of: a dragged slider makes many
_HAND_OVER, _KEEP = "Hand it over", "Keep it"


class VisitorsPanel(Panel):
    """A seat for each visitor.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        server = context.server
        self._driver_lock = driver_lock = context.driver_lock
        order = context.gui.add_html("").order  # keeps the place of what only one visitor sees
        self._seats: dict[int, _Seat] = {}
        driver_lock.on_refusal = self._refused

        @server.on_client_connect
        async def _(client: viser.ClientHandle) -> None:  # async: a visitor's coming and leaving stay in order
            driver_lock.enter(client.client_id)
            self._seats[client.client_id] = _Seat(client, driver_lock, order)

        @server.on_client_disconnect
        async def _(client: viser.ClientHandle) -> None:
            self._seats.pop(client.client_id, None)
            driver_lock.leave(client.client_id)

    def show(self, snapshot: Snapshot) -> None:
        """Say how things stand."""
        self._driver_lock.grant_if_idle()
        view = self._driver_lock.view()
        for seat in tuple(self._seats.values()):
            seat.draw(view)

    def _refused(self, client_id: int) -> None:
        if (seat := self._seats.get(client_id)) is not None:
            seat.refuse(self._driver_lock.view())


class _Seat:
    """What one visitor sees: only its own page has these widgets."""

    def __init__(self, client: viser.ClientHandle, driver_lock: DriverLock, order: float) -> None:
        self._client, self._who, gui = client, client.client_id, client.gui
        self._view = driver_lock.view()
        self._last_message_s = -_QUIET_S
        self._folder = gui.add_folder(presence(self._view, self._who), expand_by_default=False, order=order)
        with self._folder:
            self._mode = gui.add_dropdown(
                "Who drives",
                (EVERYBODY, ONE),
                initial_value=self._view.mode,
                hint="one at a time: the others look on until they get control; views, plots and files stay free",
            )
        self._mode_follows = SyncedWidget(self._mode)
        self._ask = gui.add_button(
            "Take control",
            visible=False,
            order=order + 0.1,
            hint="at once when its driver has left or done nothing for 15 s",
        )
        self._asked = gui.add_button_group(
            "Wheel", (_HAND_OVER, _KEEP), visible=False, order=order + 0.2, hint="another visitor asks for it"
        )
        self.draw(self._view)

        @self._mode.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                driver_lock.set_mode(self._who, event.target.value)

        @self._ask.on_click
        def _(_: viser.GuiEvent) -> None:
            driver_lock.request_control(self._who)

        self._asked.on_click(
            lambda event: driver_lock.reply_to_request(self._who, hand_over=event.target.value == _HAND_OVER)
        )

    def draw(self, view: DriverView) -> None:
        """Take over how things stand, and tell what has changed for this visitor."""
        before, self._view = self._view, view
        me = view.visitors.get(self._who)
        mine = me is not None and view.driver == me
        waits = me is not None and view.asking == me
        label = f"Asked visitor {view.driver} ..." if waits else "Take control"
        if not waits and view.driver is not None:
            label = f"Ask visitor {view.driver} for control"
        set_changed(self._folder, label=presence(view, self._who))
        set_changed(self._ask, visible=view.mode == ONE and not mine, label=label, disabled=waits)
        set_changed(self._asked, visible=mine and view.asking is not None)
        self._mode_follows.show(view.mode)
        self._notify(before, view, me)

    def refuse(self, view: DriverView) -> None:
        """Say why nothing has happened."""
        now = time.monotonic()
        if now - self._last_message_s >= _QUIET_S:
            self._last_message_s = now
            self._note(f"Visitor {view.driver} drives", "Ask for control to do that yourself.", "yellow")

    def _notify(self, before: DriverView, view: DriverView, me: int | None) -> None:
        if me is None or view.mode != ONE:
            return
        if view.driver == me and view.asking not in (None, before.asking):
            self._note(
                f"Visitor {view.asking} asks for control",
                "Hand it over, or keep it; after 15 s in which you do nothing it changes hands.",
                "yellow",
            )
        if view.driver != before.driver and before.mode == ONE:
            if view.driver == me:
                self._note("You drive now", "The others look on.", "green")
            elif before.driver == me:
                self._note(f"Visitor {view.driver} drives now", "You look on; ask for control to get it back.", "blue")

    def _note(self, title: str, text: str, colour: Literal["blue", "green", "yellow"]) -> None:
        self._client.add_notification(title, text, color=colour, auto_close_seconds=8.0)


def presence(view: DriverView, client_id: int) -> str:
    """One line: how many are here, which one this is, and who drives."""
    me, many = view.visitors.get(client_id), len(view.visitors)
    if view.mode == EVERYBODY:
        drives = "everybody drives"
    elif view.driver is None:
        drives = "the next to act drives"
    else:
        drives = "you drive" if view.driver == me else f"visitor {view.driver} drives"
    if many <= 1:
        return f"1 visitor: {drives if view.mode == ONE else 'you'}"
    return f"{many} visitors, you are {me}: {drives}"
