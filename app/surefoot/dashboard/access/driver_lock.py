"""Who drives: everybody, or one visitor at a time, whose commands alone pass."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from surefoot.dashboard.messages.commands import Command, HoldLink, LetGo

EVERYBODY, ONE = "everybody", "one at a time"
IDLE_S = 15.0


@dataclass(frozen=True)
class DriverView:
    """How things stand; visitors by their numbers.

    Attributes:
        visitors: who is here, client -> number.
        mode: ``EVERYBODY`` or ``ONE``.
        driver: who drives alone; None where everybody may, or nobody has begun.
        asking: who has asked the driver for control.
    """

    visitors: dict[int, int]
    mode: str
    driver: int | None
    asking: int | None


class DriverLock:
    """Passes commands on, or refuses them to those who do not drive.

    A visitor is known by the number of its connection, so that a reload is a new one. While one at a time drives, a
    free control (its driver has left) belongs to the first who does something; a driver idle for 15 s loses it to
    the first who asks. Commands that come from nobody are the page's own and pass.

    Args:
        send: takes the commands that pass.
        current_client: whose callback is running; None outside of any.
        clock: [s].
    """

    def __init__(
        self,
        send: Callable[[Command], None],
        current_client: Callable[[], int | None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._send, self._current_client, self._clock = send, current_client, clock
        self._lock = threading.RLock()
        self._visitors: dict[int, int] = {}
        self._mode = EVERYBODY
        self._driver: int | None = None
        self._asking: int | None = None
        self._last_s = 0.0
        self.on_refusal: Callable[[int], None] = lambda client_id: None

    def view(self) -> DriverView:
        """How things stand."""
        with self._lock:
            number = self._visitors.get
            driver = None if self._driver is None else number(self._driver)
            asking = None if self._asking is None else number(self._asking)
            return DriverView(dict(self._visitors), self._mode, driver, asking)

    def holder(self) -> int | None:
        """The number of the visitor who drives alone; None where a newcomer may do something."""
        return self.view().driver

    def enter(self, client_id: int) -> None:
        """A visitor comes: it gets the smallest free number."""
        with self._lock:
            taken = set(self._visitors.values())
            self._visitors[client_id] = next(number for number in range(1, len(taken) + 2) if number not in taken)

    def leave(self, client_id: int) -> None:
        """A visitor leaves: what it held is let go of, control too."""
        with self._lock:
            self._visitors.pop(client_id, None)
            if self._asking == client_id:
                self._asking = None
            if self._driver == client_id:
                self._give(self._asking)
        self._send(LetGo(str(client_id)))

    def send(self, command: Command) -> None:
        """Pass a command on, or refuse it. Who lets go may always."""
        if isinstance(command, LetGo):
            self._send(command)
            return
        hand = isinstance(command, HoldLink)  # sent again and again by the page, for its owner
        client_id = int(command.client_id) if hand else self._current_client()
        if self.accepts(client_id):
            self._send(command)

    def accepts(self, client_id: int | None) -> bool:
        """Whether that visitor may do something now; who drives, or takes free control by it, is active again."""
        with self._lock:
            if client_id is None or self._mode == EVERYBODY:
                return True
            if self._driver is None and client_id in self._visitors:
                self._give(client_id)
            if self._driver == client_id:
                self._last_s = self._clock()
                return True
        self.on_refusal(client_id)
        return False

    def set_mode(self, client_id: int, mode: str) -> bool:
        """Let everybody drive, or from now on only who says so. False: another one drives."""
        with self._lock:
            if not self.accepts(client_id):
                return False
            self._mode = mode
            self._give(client_id if mode == ONE else None)
            return True

    def request_control(self, client_id: int) -> bool:
        """Want control: true when it was free, or its driver idle, and has been taken; else the driver is asked."""
        with self._lock:
            if self._mode == EVERYBODY or client_id not in self._visitors or self._driver == client_id:
                return True
            self._asking = client_id
            return self.grant_if_idle()

    def grant_if_idle(self) -> bool:
        """Give control to who has asked, once it is free or its driver idle; true when that happened."""
        with self._lock:
            idle = self._driver is None or self._clock() - self._last_s >= IDLE_S
            if self._asking is None or not idle:
                return False
            self._give(self._asking)
            return True

    def reply_to_request(self, client_id: int, *, hand_over: bool) -> None:
        """What the driver says to who has asked."""
        with self._lock:
            if self._driver != client_id or self._asking is None:
                return
            if hand_over:
                self._give(self._asking)
            else:
                self._asking, self._last_s = None, self._clock()

    def _give(self, client_id: int | None) -> None:
        """Another one drives: nobody else keeps a link in his hand."""
        self._driver, self._asking, self._last_s = client_id, None, self._clock()
        if client_id is not None:
            for other in self._visitors:
                if other != client_id:
                    self._send(LetGo(str(other)))
