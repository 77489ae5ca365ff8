"""Commands about controller and settings: change them, go back and forth among the changes, take over a whole set."""

from collections.abc import Callable
from typing import Any

from surefoot.control.settings import settings_differences
from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.observation.event_log import LogLine
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.errors import InvalidInput


def set_controller(live: LiveRun, command: cmd.SetController) -> LogLine | None:
    """Another controller drives; what was changed of the settings stays. Raises InvalidInput, PostureError."""
    before = live.controller
    if command.name == before:
        return None
    live.hand_over(command.name, dict(live.changes))
    return _line(f"controller {before} -> {command.name}")


def change_settings(live: LiveRun, command: cmd.ChangeSettings) -> LogLine | None:
    """Change some settings. Raises InvalidInput, PostureError."""
    changes = {key: value for key, value in command.changes.items() if getattr(live.settings, key, None) != value}
    if not changes:
        return None
    live.hand_over(live.controller, {**live.changes, **changes}, command.drag_id)
    return _line(", ".join(f"{key} = {value}" for key, value in changes.items()), " ".join(changes))


def reset_settings(live: LiveRun, command: cmd.ResetSettings) -> LogLine:
    """Those of scenario and controller again."""
    live.hand_over(live.controller, {})
    return _line(f"settings of {live.controller} back to its defaults")


def undo(live: LiveRun, command: cmd.UndoSettings) -> LogLine:
    """Take the last change of controller and settings back. Raises InvalidInput when there is none."""
    to, stack = live.undo.undo()
    live.hand_over(to.controller, dict(to.changes))
    live.undo = stack
    return _line(f"undone: {_change_text(stack.undone[-1].before, stack.undone[-1].after)}")


def redo(live: LiveRun, command: cmd.RedoSettings) -> LogLine:
    """Make the change that was undone last again. Raises InvalidInput when there is none."""
    to, stack = live.undo.redo()
    live.hand_over(to.controller, dict(to.changes))
    live.undo = stack
    return _line(f"redone: {_change_text(stack.done[-1].before, stack.done[-1].after)}")


def use_settings(live: LiveRun, command: cmd.UseSettings) -> LogLine | None:
    """Take over a whole set: fields that it does not name are those of scenario and controller. Raises InvalidInput."""
    controller = command.controller or live.controller
    defaults = live.settings_of(controller, {})
    known = {name for name in vars(defaults) if not name.startswith("_")}
    if unknown := [name for name in command.settings if name not in known]:
        raise InvalidInput(f"controller.{unknown[0]}", command.settings[unknown[0]], "unknown setting", sorted(known))
    wanted = live.settings_of(controller, command.settings)
    changes = {name: value for name, _, value in settings_differences(defaults, wanted)}
    if (controller, wanted) == (live.controller, live.settings):
        return None
    live.hand_over(controller, changes)
    said = f": {', '.join(f'{name} = {value}' for name, value in changes.items())}" if changes else ": all defaults"
    return _line(f"{command.label}, controller {controller}{said}")


def _line(text: str, topic: str = "") -> LogLine:
    return LogLine(EventKind.CONTROLLER, text, topic)


def _change_text(before: Any, after: Any) -> str:
    if before.controller != after.controller:
        return f"controller {before.controller} -> {after.controller}"
    changed = settings_differences(before.settings, after.settings)
    return ", ".join(f"{name} {_plain(a)} -> {_plain(b)}" for name, a, b in changed)


def _plain(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


HANDLERS: dict[type, Callable[[LiveRun, Any], LogLine | None]] = {
    cmd.SetController: set_controller,
    cmd.ChangeSettings: change_settings,
    cmd.ResetSettings: reset_settings,
    cmd.UndoSettings: undo,
    cmd.RedoSettings: redo,
    cmd.UseSettings: use_settings,
}
