"""Steering a robot while it walks: longer and shorter steps, turns, stop and go; buttons, and keys."""

import math
from collections.abc import Callable
from typing import Literal

import viser

from surefoot.dashboard.messages.command_base import Command
from surefoot.dashboard.messages.commands import SteerWalk, StopWalk
from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.help.keys import key_name
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.experiments.scenario.own_ranges import own_range
from surefoot.experiments.scenario.proportions import scaled
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.gait.footsteps import Pace

LONGER_M, TURN_DEG = 0.05, 5.0  # of one press; the length is Bip's, another robot's goes with its legs
_DIGITS = 9  # sums of presses have dust in their last digits
_LEFT, _STRAIGHT, _RIGHT, _SLOWER, _FASTER = "turn left", "straight on", "turn right", "slower", "faster"
_STOP, _ON = "stop", "go on"
# Where a keyboard lacks the first four, Fn with an arrow is one. Not the arrows themselves: with these viser turns the
# camera, whatever is held with them
_KEYS: dict[str, Literal["pageup", "pagedown", "home", "end", "H", "G"]] = {
    _FASTER: "pageup",
    _SLOWER: "pagedown",
    _LEFT: "home",
    _RIGHT: "end",
    _STOP: "H",
    _ON: "G",
}
_HELP = {
    _FASTER: f"steps longer by {LONGER_M:g} m (Bip; others in proportion)",
    _SLOWER: f"steps shorter by {LONGER_M:g} m (Bip; others in proportion), in the end backwards",
    _LEFT: f"{TURN_DEG:g}° more to the left in each step",
    _RIGHT: f"{TURN_DEG:g}° more to the right in each step",
    _STRAIGHT: "no turn",
    _STOP: "the next step sets the feet beside each other",
    _ON: "as many steps as Steps says are to come; after the last one it walks on",
}


class Steering(Panel):
    """Buttons and keys; what is asked for holds from the next lift-off on.

    Args:
        context: of the page.
        steps: gives how many steps are to come when it goes on.
    """

    def __init__(self, context: PageContext, steps: Callable[[], int]) -> None:
        self._send, self._newest, self._steps = context.send, context.newest, steps
        gui = context.gui
        hint = "from the next lift-off on. "
        for label, words in (("Steer", (_LEFT, _STRAIGHT, _RIGHT)), ("Pace", (_SLOWER, _FASTER, _STOP, _ON))):
            said = "; ".join(f"{word} = {_HELP[word]}" for word in words)
            keys = ", ".join(f"{key_name(_KEYS[word])} = {word}" for word in words if word in _KEYS)
            gui.add_button_group(label, words, hint=f"{hint}{said}. Keys: {keys}").on_click(self._pressed)
        self._line = gui.add_html(steering_html(context.newest()))
        for word, key in _KEYS.items():
            command = gui.add_command(f"Walk: {word}", description=_HELP[word], hotkey=key)
            command.on_trigger(lambda _, word=word: self._do(word))

    def show(self, snapshot: Snapshot) -> None:
        """Say which steps are to come."""
        set_changed(self._line, content=steering_html(snapshot))

    def _pressed(self, event: viser.GuiEvent) -> None:
        self._do(event.target.value)

    def _do(self, word: str) -> None:
        newest = self._newest()
        self._send(steered(word, newest.walk.pace if newest.walk else None, self._steps(), newest.robot))


def steered(word: str, pace: Pace | None, steps: int, robot: ShownRobot) -> Command:
    """What a button asks for.

    Args:
        word: on it.
        pace: of the steps to come; None of a robot that does not walk, which will say so.
        steps: how many when it goes on.
        robot: who walks.
    """
    if word == _STOP or pace is None:
        return StopWalk()
    longer_m = scaled(LONGER_M, robot.leg)
    length_m = pace.length_m + {_SLOWER: -longer_m, _FASTER: longer_m}.get(word, 0.0)
    turn_deg = math.degrees(pace.turn_rad) + {_LEFT: TURN_DEG, _RIGHT: -TURN_DEG}.get(word, 0.0)
    return SteerWalk(
        step_length_m=_within("step_length_m", length_m, robot),
        turn_deg_per_step=_within("turn_deg_per_step", 0.0 if word == _STRAIGHT else turn_deg, robot),
        steps=steps if word == _ON else 0,
    )


def steering_html(snapshot: Snapshot) -> str:
    """Length and turn of the steps to come, and how many they are."""
    walk = snapshot.walk
    if walk is None or walk.pace is None:
        text = "Steering: the robot does not walk now."
    else:
        turn = round(math.degrees(walk.pace.turn_rad), _DIGITS)
        side = f"{abs(turn):g}° to the {'left' if turn > 0.0 else 'right'}" if turn else "straight on"
        text = f"{walk.planned - walk.made} steps to come: {100.0 * walk.pace.length_m:.0f} cm each, {side}."
    return f'<div role="status" aria-label="Steering" style="padding:2px 10px;font-size:12px">{text}</div>'


def _within(name: str, value: float, robot: ShownRobot) -> float:
    low, high = own_range(ReferenceSpec, name, robot.key)
    return round(min(max(value, low), high), _DIGITS)
