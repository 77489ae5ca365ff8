"""Play, pause, step, reset, speed, scenario, and which controller is active."""

from typing import Literal

import viser

from surefoot.dashboard.messages.commands import (
    FASTEST,
    SLOWEST,
    ChooseRobot,
    LoadScenario,
    Reset,
    SetController,
    SetSpeed,
    Step,
    TogglePlay,
)
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.panels.scenarios.gallery import scenario_texts
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.sliders import add_slider
from surefoot.dashboard.ui.synced_widget import SyncedWidget, set_changed

_PLAY, _STEP, _RESET = "Play / pause", "Step 10 ms", "Reset"


class RunPanel(Panel):
    """The controls of the run.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        scenarios = scenario_texts()
        names = list(dict.fromkeys([first.scenario, *scenarios]))
        listing = "; ".join(f"{name}: {text}" for name, text in scenarios.items())
        self._scenario = gui.add_dropdown(
            "Scenario", names, initial_value=first.scenario, hint=f"What happens to the robot. {listing}"
        )
        self._robots = context.robots
        self._robot = gui.add_dropdown(
            "Robot",
            tuple(self._robots),
            initial_value=self._title(first),
            hint="starts the scenario again with another one; of your own: surefoot dashboard --robot FILE",
        )
        buttons = gui.add_button_group(
            "Run",
            (_PLAY, _STEP, _RESET),
            hint="Keys: space = play / pause, N = step 10 ms, R = reset to the start "
            "of the scenario (controller, settings and friction stay)",
        )
        self._speed = add_slider(
            gui, "Speed [×]", SLOWEST, FASTEST, 0.1, first.speed, hint="simulated seconds per second of the wall clock"
        )

        self._follows_scenario, self._follows_speed = SyncedWidget(self._scenario), SyncedWidget(self._speed)
        self._follows_robot = SyncedWidget(self._robot)

        @self._scenario.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(LoadScenario(event.target.value))

        @self._robot.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event) and (chosen := self._robots.get(event.target.value)) is not None:
                send(ChooseRobot(chosen))

        @buttons.on_click
        def _(event: viser.GuiEvent) -> None:
            send({_PLAY: TogglePlay(), _STEP: Step(10), _RESET: Reset()}[event.target.value])

        @self._speed.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(SetSpeed(float(event.target.value)))

        # not S for the step: with W, A, S, D, Q, E and the arrows viser moves the camera
        gui.add_command(_PLAY, hotkey="space").on_trigger(lambda _: send(TogglePlay()))
        gui.add_command(_STEP, hotkey="N").on_trigger(lambda _: send(Step(10)))
        gui.add_command(_RESET, hotkey="R").on_trigger(lambda _: send(Reset()))

    def show(self, snapshot: Snapshot) -> None:
        """Take over what the session does."""
        if snapshot.scenario not in self._scenario.options:
            self._scenario.options = (*self._scenario.options, snapshot.scenario)
        self._follows_scenario.show(snapshot.scenario)
        self._follows_robot.show(self._title(snapshot))
        self._follows_speed.show(snapshot.speed)

    def _title(self, snapshot: Snapshot) -> str:
        return next(title for title, key in self._robots.items() if key == snapshot.robot.key)


_KEYS: tuple[Literal["1", "2", "3", "4", "5", "6", "7", "8", "9"], ...] = ("1", "2", "3", "4", "5", "6", "7", "8", "9")


class ControllerPanel(Panel):
    """The dropdown and the keys 1 to 9.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        self._help = controllers = context.controllers
        keys = "; ".join(f"{i} = {name}" for i, name in enumerate(list(controllers)[: len(_KEYS)], start=1))
        unavailable = "".join(
            f". Not available: {name}, {reason}" for name, reason in context.unavailable_controllers.items()
        )
        self._choice = gui.add_dropdown(
            "Controller",
            list(controllers),
            initial_value=first.controller,
            hint=f"Who decides the torques; a switch fades over 50 ms. Keys: {keys}{unavailable}",
        )
        self._line, self._follower = gui.add_markdown(self._text(first.controller)), SyncedWidget(self._choice)

        @self._choice.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(SetController(event.target.value))

        for key, name in zip(_KEYS, controllers, strict=False):
            command = gui.add_command(f"Controller {name}", description=controllers[name], hotkey=key)
            command.on_trigger(lambda _, chosen=name: send(SetController(chosen)))

    def show(self, snapshot: Snapshot) -> None:
        """Take over which controller is active."""
        self._follower.show(snapshot.controller)
        set_changed(self._line, content=self._text(snapshot.controller))

    def _text(self, name: str) -> str:
        return f"<small>{self._help.get(name, '')}</small>"
