"""A/B: two sets of controller and settings, switched live with one click, told apart in a table, run as twins."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape

from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.messages.commands import StartTwin, UseSettings
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.setting_labels import FIELDS, label_of, value_text
from surefoot.dashboard.ui.synced_widget import set_changed

A, B = "A", "B"
_COLOURS = {A: palette.css(palette.FIRST), B: palette.css(palette.TWIN)}
_HELP = "Tune, store as A, tune on, store as B. Then switch between them while the robot balances, or let both run."


@dataclass(frozen=True)
class Slot:
    """What one letter holds."""

    controller: str
    settings: ControllerSettings

    @classmethod
    def of(cls, snapshot: Snapshot) -> "Slot":
        """What is active."""
        return cls(snapshot.controller, snapshot.settings)

    def command(self, letter: str) -> UseSettings:
        """What brings it to work."""
        return UseSettings(settings=self.table(), label=f"settings {letter}", controller=self.controller)

    def table(self) -> dict[str, object]:
        """Every setting by name."""
        return dataclasses.asdict(self.settings)


class SlotsPanel(Panel):
    """Store, switch, compare; the slots are the page's, so all visitors share them.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, newest = context.gui, context.newest
        self._slots: dict[str, Slot] = {}
        self._send, self._newest = context.send, newest
        gui.add_markdown(f"<small>{_HELP}</small>")
        store = gui.add_button_group("Store as", (A, B), hint="keep controller and settings as they are now")
        self._table = gui.add_html("")
        self._switch = gui.add_button(
            "Switch A / B",
            disabled=True,
            hint=("to the one that is not at work; the torques fade over 50 ms, and it can be undone. Key: X"),
        )
        self._twin = gui.add_button(
            "Run A against B as twins",
            disabled=True,
            color="gray",
            hint=(
                "both robots begin at the start of the scenario, the first with A, the twin with B; "
                "what is done to one is done to both"
            ),
        )
        store.on_click(lambda event: self._store(event.target.value))
        self._switch.on_click(lambda _: self._toggle())
        self._twin.on_click(lambda _: self._run())
        key = gui.add_command("Switch between settings A and B", description="as stored in the tab A/B", hotkey="X")
        key.on_trigger(lambda _: self._toggle())
        self.show(newest())

    def show(self, snapshot: Snapshot) -> None:
        """Say what each letter holds, which is active, and where they differ."""
        now = Slot.of(snapshot)
        set_changed(self._table, content=slots_html(self._slots, now))
        label = f"Switch to {self._next(now)}" if self._slots else "Switch A / B"
        set_changed(self._switch, label=label, disabled=not self._slots)
        set_changed(self._twin, disabled=len(self._slots) != 2)

    def _store(self, letter: str) -> None:
        self._slots = {**self._slots, letter: Slot.of(self._newest())}
        self.show(self._newest())

    def _next(self, now: Slot) -> str:
        """The letter that a switch goes to: B when A is active, else A; the only one when there is but one."""
        if len(self._slots) == 1:
            return next(iter(self._slots))
        return B if now == self._slots[A] else A

    def _toggle(self) -> None:
        if self._slots:
            letter = self._next(Slot.of(self._newest()))
            self._send(self._slots[letter].command(letter))

    def _run(self) -> None:
        if len(self._slots) == 2:
            self._send(self._slots[A].command(A))
            self._send(StartTwin(self._slots[B].controller, self._slots[B].table()))


def slots_html(slots: Mapping[str, Slot], now: Slot) -> str:
    """A column for each letter, and one for what is active where that is neither."""
    at_work = [letter for letter in sorted(slots) if slots[letter] == now]
    columns = {letter: slots[letter] for letter in sorted(slots)}
    if not at_work:
        columns["now"] = now
    if not slots:
        said = "Nothing is stored yet."
    elif len(columns) == 1 and at_work:
        said = f"{at_work[0]} is at work; change something, and store it as {B if at_work[0] == A else A}."
    else:
        said = f"at work: <b>{' = '.join(at_work)}</b>" if at_work else "at work: neither"
    return (
        '<div aria-label="Settings A and B" style="padding:2px 10px 6px;font-size:12px;line-height:1.4;color:inherit">'
        f"<div>{said}</div>{_table(columns, at_work) if slots else ''}</div>"
    )


def _table(columns: Mapping[str, Slot], at_work: list[str]) -> str:
    if len(columns) == 1:
        return ""
    rows = [("Controller", [slot.controller for slot in columns.values()])]
    rows += [
        (label_of(field), [value_text(getattr(slot.settings, name)) for slot in columns.values()])
        for name, field in FIELDS.items()
        if len({getattr(slot.settings, name) for slot in columns.values()}) > 1
    ]
    if len(set(rows[0][1])) == 1:
        rows = rows[1:]
    if not rows:
        return "<div>They are the same.</div>"
    cell = 'style="text-align:right;padding:1px 0 1px 8px;overflow-wrap:anywhere"'
    heads = "".join(
        f'<th {cell}><span style="color:{_COLOURS.get(name, "inherit")}">'
        f"{name}{' ●' if name in at_work else ''}</span></th>"
        for name in columns
    )
    body = "".join(
        f'<tr style="border-top:1px solid #8884"><td style="padding:1px 0">{escape(label)}</td>'
        f"{''.join(f'<td {cell}>{escape(value)}</td>' for value in values)}</tr>"
        for label, values in rows
    )
    return (
        '<div style="max-height:330px;overflow-y:auto;margin-top:3px">'
        '<table style="width:100%;border-collapse:collapse;'
        f'font-variant-numeric:tabular-nums"><tr><td style="opacity:0.75">{len(rows)} differ</td>{heads}</tr>{body}'
        "</table></div>"
    )
