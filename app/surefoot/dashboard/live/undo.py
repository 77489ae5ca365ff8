"""What is tuned, and how it was before: the last changes of controller and settings, to be undone and redone.

A stack is a value: a checkpoint of the run keeps it, and a past that is gone back to has the stack it had.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from surefoot.control.settings import ControllerSettings, settings_differences
from surefoot.dashboard.messages.snapshot import SettingsChange, TuningView
from surefoot.errors import InvalidInput

MOST_STEPS = 50
SettingsOf = Callable[[str, Mapping[str, Any]], ControllerSettings]


@dataclass(frozen=True)
class Tuning:
    """A controller and its settings; equal when they do the same.

    Attributes:
        controller: name.
        changes: what the user changed of its settings.
        settings: what that came to when it was done.
    """

    controller: str
    changes: Mapping[str, Any] = field(compare=False)
    settings: ControllerSettings


@dataclass(frozen=True)
class TuningStep:
    """One change.

    Attributes:
        before, after: what was tuned.
        drag_id: number of the slider's drag that it belongs to; 0 for none.
    """

    before: Tuning
    after: Tuning
    drag_id: int = 0


@dataclass(frozen=True)
class UndoStack:
    """Changes that can be undone and, once undone, redone; the last one of each is the next.

    Attributes:
        done, undone: steps.
    """

    done: tuple[TuningStep, ...] = ()
    undone: tuple[TuningStep, ...] = ()

    def push(self, before: Tuning, after: Tuning, drag_id: int = 0) -> "UndoStack":
        """With one step more; steps of one drag are one, and one that ends where it began is none."""
        done = self.done
        if drag_id and not self.undone and done and done[-1].drag_id == drag_id:
            before, done = done[-1].before, done[:-1]
        elif before == after:
            return self
        return UndoStack(done if before == after else (*done, TuningStep(before, after, drag_id))[-MOST_STEPS:])

    def undo(self) -> tuple[Tuning, "UndoStack"]:
        """What was tuned before the last step, and the stack once that is so again. Raises InvalidInput."""
        if not self.done:
            raise InvalidInput("undo", "settings", "nothing was changed that could be undone")
        step = self.done[-1]
        return step.before, UndoStack(self.done[:-1], (*self.undone, step))

    def redo(self) -> tuple[Tuning, "UndoStack"]:
        """What the last undone step had come to, and the stack once that is so again. Raises InvalidInput."""
        if not self.undone:
            raise InvalidInput("redo", "settings", "nothing was undone that could be redone")
        step = self.undone[-1]
        return step.after, UndoStack((*self.done, step), self.undone[:-1])


def tuning_view(stack: UndoStack, controller: str, settings_of: SettingsOf) -> TuningView:
    """What the page shows of it.

    Args:
        stack: what can be undone.
        controller: active.
        settings_of: what a controller's changes come to in the scenario active.
    """
    return TuningView(
        defaults=settings_of(controller, {}),
        undo=_change(stack.done[-1], settings_of) if stack.done else None,
        redo=_change(stack.undone[-1], settings_of) if stack.undone else None,
        steps=len(stack.done),
    )


def _change(step: TuningStep, settings_of: SettingsOf) -> SettingsChange:
    before, after = step.before, step.after
    values = settings_differences(*(settings_of(tuning.controller, tuning.changes) for tuning in (before, after)))
    if before.controller != after.controller and before.changes == after.changes:
        values = ()  # each controller has settings of its own
    return SettingsChange(controller=(before.controller, after.controller), values=values)
