"""Try this: steps in which a newcomer makes the baseline fall, sees the two-part law hold, and lets it walk."""

from collections.abc import Callable
from dataclasses import dataclass

import viser

from surefoot.dashboard.messages.commands import (
    Command,
    LoadScenario,
    PlaceStoneAtSole,
    Play,
    PushNow,
    Reset,
    SetController,
)
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.messages.shown_robot import FIRST_ROBOT, ShownRobot
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel

_SEEN_KEY = "surefoot-tour"
_BASELINE, _LAW, _SCENARIO = "optimization", "two-part", "stand_left"
_HEIGHT_MM, _SIZE_MM, _PUSH_NS = 12, 60, 20.0  # of stone and push, for Bip
_HELD_S = 2.5
_OTHER = "Tried out with Bip: with another robot, or a stone of another height, it may come out differently."
_WALK, _MADE = "walk_flat", 2  # so many of its steps have landed when it is said to walk


@dataclass(frozen=True)
class Step:
    """One step.

    Attributes:
        title, text: what to try and what to look at; ``{robot}`` and ``{mm}`` are its name and the stone's height.
        commands: what does it for a person, given how things stand.
        done: whether it has happened, given how things stand and how they stood when the step began.
        said: what is said then.
    """

    title: str
    text: str
    commands: Callable[[Snapshot], list[Command]]
    done: Callable[[Snapshot, Snapshot], bool]
    said: str


def height_mm(robot: ShownRobot) -> int:
    """How high the tour's stone is: as for Bip it tilts the sole by about 8 degrees at its edge."""
    return max(1, round(robot.width * _HEIGHT_MM))


def _stone(robot: ShownRobot) -> PlaceStoneAtSole:
    size_mm = max(10, 5 * round(robot.sole * _SIZE_MM / 5))  # no stone may be smaller
    return PlaceStoneAtSole(place="outer edge", height_m=1e-3 * height_mm(robot), size_m=1e-3 * size_mm)


def _push(robot: ShownRobot) -> PushNow:
    return PushNow(direction_deg=0.0, impulse_ns=round(robot.push * _PUSH_NS, 1))


def _clean(now: Snapshot, controller: str) -> list[Command]:
    """A robot that stands on nothing but the ground, and that controller."""
    messy = now.scenario != _SCENARIO or now.balance.fall_cause is not None or bool(now.geometry.stones)
    start: list[Command] = ([LoadScenario(_SCENARIO)] if now.scenario != _SCENARIO else [Reset()]) if messy else []
    return [*start, SetController(controller), Play()]


def _pushed(now: Snapshot, then: Snapshot) -> bool:
    return any(e.kind is EventKind.PUSH and e not in then.events for e in now.events) and now.balance.fall_cause is None


def _held(now: Snapshot, then: Snapshot) -> bool:
    standing = now.controller == _LAW and now.balance.fall_cause is None
    stones = [view.stone for view in now.geometry.stones]
    return standing and any(now.time_s > stone.rise_start_s + _HELD_S for stone in stones)


def _walked(now: Snapshot, then: Snapshot) -> bool:
    walk = now.walk
    return walk is not None and now.run != then.run and walk.made >= _MADE and now.balance.fall_cause is None


STEPS = (
    Step(
        "Push it",
        "{robot} stands on its left foot, held up by the orange dot (its ZMP) staying in the blue sole. "
        "Press **P**, or **shift-drag** its trunk.",
        lambda now: [*_clean(now, now.controller), _push(now.robot)],
        _pushed,
        "It recovers.",
    ),
    Step(
        "Take the older controller",
        "Choose `optimization` under *Controller*: it needs a flat sole.",
        lambda now: _clean(now, _BASELINE),
        lambda now, _: now.controller == _BASELINE,
        "It stands just as well ...",
    ),
    Step(
        "Put a stone under its foot",
        "Set *Stone height* to {mm} mm and press **outer edge**, or **ctrl-click** the outer edge of its left foot.",
        lambda now: [*_clean(now, _BASELINE), _stone(now.robot)],
        lambda now, _: now.balance.fall_cause is not None,
        "... until a stone of {mm} mm: {robot} has fallen.",
    ),
    Step(
        "Now the paper's law",
        "Press **Reset** and choose `two-part`: its ankles follow the angular momentum.",
        lambda now: [Reset(), SetController(_LAW), Play()],
        lambda now, _: now.controller == _LAW and now.balance.fall_cause is None,
        "Ready.",
    ),
    Step(
        "The same stone again",
        "**outer edge**, {mm} mm. Watch the foot roll onto the stone.",
        lambda now: [*_clean(now, _LAW), _stone(now.robot)],
        _held,
        "It holds.",
    ),
    Step(
        "Let it walk",
        "Press **Walk** in the tab *Walk*; there you can also put stones, tiles or a slope below its steps. While it "
        "walks, steer it: **Home** and **End** turn it, **PgUp** and **PgDn** make its steps longer and shorter.",
        lambda now: [SetController(_LAW), LoadScenario(_WALK)],
        _walked,
        "It walks. Go on with the *Scenarios* on the left: in *Walk over stones: one falls* two controllers walk on "
        "the very same stones.",
    ),
)


class Tour(Panel):
    """A card for each person who has not seen it yet, and the button that shows it again.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, server = context, context.server
        self._cards: dict[int, _Card] = {}
        again = context.gui.add_button(
            "Start the tour", hint=f"{len(STEPS)} steps: make the baseline fall, see the paper's law hold, let it walk"
        )
        again.on_click(lambda event: self.start(event.client) if event.client is not None else None)

        @server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            try:
                seen = client.local_storage.get_item(_SEEN_KEY, timeout=60.0)
            except (RuntimeError, TimeoutError):  # it left, or is too slow for a tour
                return
            if seen is None:
                self.start(client)
            if client.client_id not in server.get_clients():  # has left while we waited, and been forgotten
                self._cards.pop(client.client_id, None)

        @server.on_client_disconnect
        def _(client: viser.ClientHandle) -> None:
            self._cards.pop(client.client_id, None)

    def start(self, client: viser.ClientHandle) -> None:
        """Show it to a person, from the first step."""
        self._end(client)
        self._cards[client.client_id] = _Card(client, self._context, self._end)

    def show(self, snapshot: Snapshot) -> None:
        """Notice what has been done."""
        for card in tuple(self._cards.values()):
            card.look(snapshot)

    def _end(self, client: viser.ClientHandle) -> None:
        if (card := self._cards.pop(client.client_id, None)) is not None:
            card.remove()
            client.local_storage.set_item(_SEEN_KEY, "seen")


class _Card:
    """One person's card."""

    def __init__(
        self, client: viser.ClientHandle, context: PageContext, end: Callable[[viser.ClientHandle], None]
    ) -> None:
        newest = context.newest
        self._client, self._newest, self._end = client, newest, end
        self._number, self._begun, self._is_done = 0, newest(), False
        self._robot = self._begun.robot
        gui = client.gui
        self._panel = gui.add_panel()
        with self._panel.add_tab("Try this", viser.Icon.BULB):
            self._text = gui.add_markdown("")
            self._do = gui.add_button("Do it for me", color="orange")
            self._move = gui.add_button_group("Tour", ("Back", "Next", "Close"))
        self._panel.float(x=15, y=15, width=270)

        @self._do.on_click
        def _(_: viser.GuiEvent) -> None:
            for command in STEPS[self._number].commands(newest()):
                context.send(command)

        self._move.on_click(lambda event: self._go(event.target.value))
        self._write()

    def look(self, snapshot: Snapshot) -> None:
        """Say so when the step has been done."""
        if snapshot.robot.key != self._robot.key:
            self._robot, self._begun, self._is_done = snapshot.robot, snapshot, False
            self._write()
        if not self._is_done and STEPS[self._number].done(snapshot, self._begun):
            self._is_done = True
            self._write()

    def remove(self) -> None:
        """Take it off the page."""
        self._panel.remove()

    def _go(self, where: str) -> None:
        number = self._number + {"Back": -1, "Next": 1}.get(where, 0)
        if where == "Close" or number >= len(STEPS):
            self._end(self._client)
            return
        self._number, self._begun, self._is_done = max(number, 0), self._newest(), False
        self._write()

    def _write(self) -> None:
        step, robot = STEPS[self._number], self._robot
        words = {"robot": robot.title, "mm": height_mm(robot)}
        done = f"\n\n**✓ {step.said.format(**words)}**" if self._is_done else ""
        tried = "" if robot.key == FIRST_ROBOT or self._is_done else f"\n\n<small>{_OTHER}</small>"
        text = f"{step.text.format(**words)}{done}{tried}"
        self._text.content = f"**{self._number + 1}/{len(STEPS)} {step.title}**\n\n{text}"
