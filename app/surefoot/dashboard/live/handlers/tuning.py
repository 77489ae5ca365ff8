"""Commands about controller and settings: change them, go back and forth among the changes, take over a whole set."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from surefoot.dashboard.live.undo import differences
from surefoot.dashboard.messages import commands as ask
from surefoot.errors import InvalidInput

if TYPE_CHECKING:
    from surefoot.dashboard.live.live_run import Stage


def set_controller(stage: "Stage", command: ask.SetController) -> None:
    """Another controller drives; what was changed of the settings stays. Raises InvalidInput, PostureError."""
    before = stage.controller
    if command.name != before:
        stage.hand_over(command.name, dict(stage.changes))
        stage.say("controller", f"controller {before} -> {command.name}")


def change_settings(stage: "Stage", command: ask.ChangeSettings) -> None:
    """Change some settings. Raises InvalidInput, PostureError."""
    changes = {key: value for key, value in command.changes.items() if getattr(stage.settings, key, None) != value}
    if changes:
        stage.hand_over(stage.controller, {**stage.changes, **changes}, command.stroke)
        text = ", ".join(f"{key} = {value}" for key, value in changes.items())
        stage.say("controller", text, topic=" ".join(changes))


def reset_settings(stage: "Stage", command: ask.ResetSettings) -> None:
    """Those of scenario and controller again."""
    stage.hand_over(stage.controller, {})
    stage.say("controller", f"settings of {stage.controller} back to its defaults")


def undo(stage: "Stage", command: ask.UndoSettings) -> None:
    """Take the last change of controller and settings back. Raises InvalidInput when there is none."""
    to, stack = stage.undo.back()
    stage.hand_over(to.controller, dict(to.changes))
    stage.undo = stack
    stage.say("controller", f"undone: {_told(stack.undone[-1].before, stack.undone[-1].after)}")


def redo(stage: "Stage", command: ask.RedoSettings) -> None:
    """Make the change that was undone last again. Raises InvalidInput when there is none."""
    to, stack = stage.undo.forth()
    stage.hand_over(to.controller, dict(to.changes))
    stage.undo = stack
    stage.say("controller", f"redone: {_told(stack.done[-1].before, stack.done[-1].after)}")


def use_settings(stage: "Stage", command: ask.UseSettings) -> None:
    """Take over a whole set: fields that it does not name are those of scenario and controller. Raises InvalidInput."""
    controller = command.controller or stage.controller
    usual = stage.settings_of(controller, {})
    known = {name for name in vars(usual) if not name.startswith("_")}
    if unknown := [name for name in command.settings if name not in known]:
        raise InvalidInput(f"controller.{unknown[0]}", command.settings[unknown[0]], "unknown setting", sorted(known))
    wanted = stage.settings_of(controller, command.settings)
    changes = {name: value for name, _, value in differences(usual, wanted)}
    if (controller, wanted) == (stage.controller, stage.settings):
        return
    stage.hand_over(controller, changes)
    said = f": {', '.join(f'{name} = {value}' for name, value in changes.items())}" if changes else ": all defaults"
    stage.say("controller", f"{command.label}, controller {controller}{said}")


def _told(before: Any, after: Any) -> str:
    if before.controller != after.controller:
        return f"controller {before.controller} -> {after.controller}"
    changed = differences(before.settings, after.settings)
    return ", ".join(f"{name} {_plain(a)} -> {_plain(b)}" for name, a, b in changed)


def _plain(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


OBEY: dict[type, Callable[["Stage", Any], None]] = {
    ask.SetController: set_controller, ask.ChangeSettings: change_settings, ask.ResetSettings: reset_settings,
    ask.UndoSettings: undo, ask.RedoSettings: redo, ask.UseSettings: use_settings,
}  # fmt: skip
