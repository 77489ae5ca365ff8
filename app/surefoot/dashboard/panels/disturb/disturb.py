"""Pushes, the slope of the ground, friction."""

import viser

from surefoot.dashboard.messages.commands import PushNow, SetFriction, TiltGround
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.synced_widget import SyncedWidget

_MS = 1e-3
_COMPASS = ((-90, "right"), (0, "front"), (90, "left"))


class DisturbPanel(Panel):
    """What a person can do to Bip besides stones.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        with gui.add_folder("Push"):
            self._direction = gui.add_slider(
                "Direction [°]",
                -180,
                180,
                5,
                90,
                hint="0 = forward, 90 = to Bip's left, 180 = backward",
                marks=_COMPASS,
            )
            self._impulse = gui.add_slider("Impulse [N·s]", 1, 100, 1, 20, hint="force times duration, through the CoM")
            self._duration = gui.add_slider("Duration [ms]", 10, 1000, 10, 100, hint="how long the push lasts")
            push = gui.add_button("Push now", hint="key: P")
        with gui.add_folder("Ground"):
            self._slope = gui.add_slider("Slope [°]", 0, 15, 0.5, 3, hint="how steep the ground will be")
            self._towards = gui.add_slider(
                "Rises to [°]",
                -180,
                180,
                15,
                0,
                hint="0 = forward, 90 = to Bip's left, 180 = backward",
                marks=_COMPASS,
            )
            self._within = gui.add_slider("Tilt within [s]", 0.1, 5, 0.1, 1, hint="how long the ground takes to turn")
            tilt = gui.add_button_group("Turn it", ("tilt", "level"), hint="while Bip stands on it")
            self._friction = gui.add_slider(
                "Friction μ [-]",
                0.05,
                2.0,
                0.05,
                first.friction,
                hint="of ground and stones; the controller counts on its own value (Gains, Weights and solver)",
            )

        push.on_click(lambda _: send(self._push()))
        gui.add_command("Push now", hotkey="P").on_trigger(lambda _: send(self._push()))

        @tilt.on_click
        def _(event: viser.GuiEvent) -> None:
            slope = float(self._slope.value) if event.target.value == "tilt" else 0.0
            send(
                TiltGround(
                    slope_deg=slope, direction_deg=float(self._towards.value), duration_s=float(self._within.value)
                )
            )

        self._follower = SyncedWidget(self._friction)

        @self._friction.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(SetFriction(float(event.target.value)))

    def show(self, snapshot: Snapshot) -> None:
        """Take over the friction active."""
        self._follower.show(snapshot.friction)

    def _push(self) -> PushNow:
        return PushNow(
            direction_deg=float(self._direction.value),
            impulse_ns=float(self._impulse.value),
            duration_s=self._duration.value * _MS,
        )
