"""A walk of one's own: steps, timing and ground, and the button that starts it."""

from collections.abc import Mapping
from typing import Any

import viser

from surefoot.dashboard.messages.commands import LoadScenario
from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.panels.walk.steering import Steering
from surefoot.dashboard.panels.walk.walk_ground import SLOPES, TILES, word_of
from surefoot.dashboard.ui.sliders import add_number, add_slider, set_range, steps_within
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.experiments.scenario.own_ranges import own_range
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.experiments.scenario.uneven_ground import StonesUnderSteps
from surefoot.field_metadata import described, range_of

BASE = "walk_flat"  # what a walk is when nothing is changed of it
_STEPS = {
    "steps": "Steps",
    "step_length_m": "Step length [m]",
    "step_width_m": "Step width [m]",
    "step_period_s": "Step period [s]",
    "double_support_share": "Double support share [-]",
    "lift_m": "Foot lift [m]",
    "turn_deg_per_step": "Turn per step [°]",
    "first_foot": "First foot",
}
_STONE_STEP_MM = 5
_STONES, _MM, _DIGITS = "stones_under_steps.height_m", 1e-3, 9  # a slider's sum of steps has dust in its last digits


class WalkPanel(Panel):
    """What the next walk is to be, and how the one that goes on is steered.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, self._send, robot = context.gui, context.send, context.newest().robot
        self._robot, self._usual = robot.key, _usual(robot)
        walk = gui.add_button("Walk", hint=f"the scenario {BASE} with these values", color="orange")
        gui.add_markdown("<small>It starts from where every walk begins; controller and gains stay.</small>")
        self._steering = Steering(context, lambda: _whole(self._steps["reference.steps"].value))
        self._steps = {f"reference.{name}": _widget(gui, name, self._usual[f"reference.{name}"]) for name in _STEPS}
        lowest, highest = range_of(StonesUnderSteps, "height_m")
        with gui.add_folder("Ground of the walk"):
            self._tiles = gui.add_dropdown("Tiles", tuple(TILES), hint="10 cm wide, each as high as chance has it")
            self._stones = add_slider(
                gui,
                "Stones under steps [mm]",
                lowest / _MM,
                highest / _MM,
                _STONE_STEP_MM,
                0,
                hint="how high the stone is that lies somewhere under each planned step; 0: none",
            )
            self._slope = gui.add_dropdown("Slope", tuple(SLOPES), hint="of the ground, seen from the start")
        self._scale(robot)
        walk.on_click(lambda _: self._walk())
        self._run, self._own = -1, False
        self.show(context.newest())

    def show(self, snapshot: Snapshot) -> None:
        """Take over the values of a walk that was started otherwise: by a link, or from the gallery."""
        self._steering.show(snapshot)
        if snapshot.robot.key != self._robot:
            self._suit(snapshot.robot)
        if snapshot.run == self._run:
            return
        own, self._run, self._own = self._own, snapshot.run, False
        if own or snapshot.scenario != BASE or snapshot.changes is None:
            return
        changes = snapshot.changes
        for path, widget in self._steps.items():
            set_changed(widget, value=_shown(changes.get(path, self._usual[path])))
        set_changed(self._stones, value=changes.get(_STONES, 0.0) / _MM)
        for menu, widget in ((TILES, self._tiles), (SLOPES, self._slope)):
            if (word := word_of(menu, changes)) is not None:
                set_changed(widget, value=word)

    def _suit(self, robot: ShownRobot) -> None:
        """Sliders and usual values of another robot."""
        self._robot, self._usual = robot.key, _usual(robot)
        self._scale(robot)
        set_changed(self._stones, value=min(self._stones.value, self._stones.max))
        for path, widget in self._steps.items():
            set_changed(widget, value=_shown(self._usual[path]))

    def _scale(self, robot: ShownRobot) -> None:
        for name in _STEPS:
            meta = described(ReferenceSpec, name)
            if meta.get("goes_with"):
                ends = steps_within(*own_range(ReferenceSpec, name, robot.key), meta["step"], robot.leg)
                set_range(self._steps[f"reference.{name}"], *ends)
        highest, step = range_of(StonesUnderSteps, "height_m")[1] / _MM, _STONE_STEP_MM
        most = min(highest, step * round(robot.sole * highest / step))
        set_range(self._stones, *steps_within(0.0, most, step, robot.sole))

    def _walk(self) -> None:
        self._own = True  # what has been moved since is not to be put back when this walk is seen
        self._send(LoadScenario(BASE, self._changes()))

    def _changes(self) -> Mapping[str, Any]:
        """Only what is not as usual: the log and a link need not say the rest."""
        steps = {path: _exact(widget.value) for path, widget in self._steps.items()}
        changes = {path: value for path, value in steps.items() if value != self._usual[path]}
        if self._stones.value > 0.0:
            changes[_STONES] = _exact(self._stones.value * _MM)
        return {**changes, **TILES[self._tiles.value], **SLOPES[self._slope.value]}


def _usual(robot: ShownRobot) -> dict[str, Any]:
    """Dotted path of each widget -> what it is in the scenario where nothing is changed."""
    reference = load_scenario(BASE, {"robot": robot.key}, robot_files=True).reference
    return {f"reference.{name}": getattr(reference, name) for name in _STEPS}


def _widget(gui: viser.GuiApi, name: str, value: Any) -> Any:
    """As the field of the reference is described: range, step and help."""
    meta = described(ReferenceSpec, name)
    label, hint = _STEPS[name], meta["help"].removeprefix("walk: ")
    if meta["kind"] == "choice":
        return gui.add_dropdown(label, meta["valid"], initial_value=value, hint=hint)
    if meta["kind"] == "count":  # thousands: a slider would be useless; the session knows the range
        return add_number(gui, label, value, 1.0, hint)
    return add_slider(gui, label, meta["low"], meta["high"], meta["step"], value, hint=hint)


def _whole(number: float) -> Any:
    """As a whole number, if it is one; what is none, the session refuses in words."""
    return int(number) if float(number).is_integer() else number


def _shown(value: Any) -> Any:
    """A number as a widget is to hold it: one that is given a whole number makes whole numbers of all that follow."""
    return float(value) if isinstance(value, int) else value


def _exact(value: Any) -> Any:
    return round(value, _DIGITS) if isinstance(value, float) else value
