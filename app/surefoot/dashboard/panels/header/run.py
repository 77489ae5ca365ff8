"""Play, pause, step, reset, speed, scenario."""

import viser

from surefoot.dashboard.messages.commands import FASTEST, SLOWEST, LoadScenario, Reset, SetSpeed, Step, TogglePlay
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.panels.scenarios.catalogue import scenario_texts
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.synced_widget import SyncedWidget

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
            "Scenario", names, initial_value=first.scenario, hint=f"What happens to Bip. {listing}"
        )
        buttons = gui.add_button_group(
            "Run",
            (_PLAY, _STEP, _RESET),
            hint="Keys: space = play / pause, N = step 10 ms, R = reset to the start "
            "of the scenario (controller, settings and friction stay)",
        )
        self._speed = gui.add_slider(
            "Speed [×]", SLOWEST, FASTEST, 0.1, first.speed, hint="simulated seconds per second of the wall clock"
        )

        self._follows_scenario, self._follows_speed = SyncedWidget(self._scenario), SyncedWidget(self._speed)

        @self._scenario.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(LoadScenario(event.target.value))

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
        self._follows_speed.show(snapshot.speed)
