"""From event to event: the way to look at a run after it, one stop for what belongs together."""

from collections.abc import Callable

from surefoot.dashboard.messages.commands import Seek
from surefoot.dashboard.messages.snapshot import TimelineView
from surefoot.dashboard.panels.page_context import PageContext

_BEFORE, _NEXT = "◀ event before", "next event ▶"
_SAME_S = 6e-4
_TOGETHER_S = 0.2  # a dragged slider, or a foot that loses its hold bit by bit, is one stop


def add_event_steps(context: PageContext) -> None:
    """Add two buttons and two keys."""
    gui = context.gui
    hint = "go to the instant of a stone, push, limit, change or fall of the last 30 s, and stand still there"
    buttons = gui.add_button_group("Go to", (_BEFORE, _NEXT), hint=f"{hint}. Keys: J = before, K = next")
    steps = {_BEFORE: event_before, _NEXT: event_after}

    def go(where: Callable[[TimelineView], float | None]) -> None:
        if (time_s := where(context.newest().timeline)) is not None:
            context.send(Seek(time_s))

    buttons.on_click(lambda event: go(steps[event.target.value]))
    before = gui.add_command("Event before", description=hint, hotkey="J")
    following = gui.add_command("Next event", description=hint, hotkey="K")
    before.on_trigger(lambda _: go(event_before))
    following.on_trigger(lambda _: go(event_after))


def stops(view: TimelineView) -> list[float]:
    """Instants [s] of the kept events, ascending; those of one kind that follow each other closely are one."""
    found: list[float] = []
    latest: dict[str, float] = {}
    for mark in sorted(view.marks, key=lambda mark: mark.time_s):
        if not view.oldest_s <= mark.time_s <= view.newest_s:
            continue
        close = mark.time_s - latest.get(mark.kind, float("-inf")) < _TOGETHER_S
        latest[mark.kind] = mark.time_s
        if not close and not (found and mark.time_s - found[-1] < _SAME_S):
            found.append(mark.time_s)
    return found


def event_before(view: TimelineView) -> float | None:
    """The stop before now [s], if there is one."""
    return next((time_s for time_s in reversed(stops(view)) if time_s < view.now_s - _SAME_S), None)


def event_after(view: TimelineView) -> float | None:
    """The stop after now [s], if there is one."""
    return next((time_s for time_s in stops(view) if time_s > view.now_s + _SAME_S), None)
