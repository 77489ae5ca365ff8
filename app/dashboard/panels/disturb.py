"""Stones, pushes, friction."""

from collections.abc import Iterable

import viser

from app.dashboard.commands import ClearStones, PlaceStoneAtSole, PushNow, RemoveLastStone, SetFriction
from app.dashboard.panels.fields import Send, from_browser
from app.dashboard.snapshot import Snapshot

_MM = 1e-3


class DisturbPanel:
    """What a person can do to Bip.

    Args:
        gui: where to add it.
        send: takes the commands.
        places: of the sole.
        first: the snapshot to show first.
    """

    def __init__(self, gui: viser.GuiApi, send: Send, places: Iterable[str], first: Snapshot) -> None:
        gui.add_markdown("**Ctrl-click** the ground or a foot: a stone comes up under a sole, drops elsewhere.")
        self._height = gui.add_slider("Stone height [mm]", 1, 40, 1, 10, hint="how far its top stands above the ground")
        self._size = gui.add_slider("Stone size [mm]", 20, 200, 5, 60, hint="its length and width")
        under = gui.add_button_group("Stone under", tuple(places), hint="place it under the sole that stands")
        remove = gui.add_button_group("Stones", ("remove last", "clear all"), hint="take stones away")
        with gui.add_folder("Push"):
            self._direction = gui.add_slider(
                "Direction [°]", -180, 180, 5, 90, hint="0 = forward, 90 = to Bip's left, 180 = backward",
                marks=((-90, "right"), (0, "front"), (90, "left")),
            )  # fmt: skip
            self._impulse = gui.add_slider("Impulse [N·s]", 1, 100, 1, 20, hint="force times duration, through the CoM")
            self._duration = gui.add_slider("Duration [ms]", 10, 1000, 10, 100, hint="how long the push lasts")
            push = gui.add_button("Push now", hint="key: P")
        self._friction = gui.add_slider(
            "Friction μ [-]",
            0.05,
            2.0,
            0.05,
            first.friction,
            hint="of ground and stones; the controller counts on its own value (Gains, Weights and solver)",
        )

        @under.on_click
        def _(event: viser.GuiEvent) -> None:
            height_m, size_m = self.stone()
            send(PlaceStoneAtSole(place=event.target.value, height_m=height_m, size_m=size_m))

        @remove.on_click
        def _(event: viser.GuiEvent) -> None:
            send(RemoveLastStone() if event.target.value == "remove last" else ClearStones())

        push.on_click(lambda _: send(self._push()))
        gui.add_command("Push now", hotkey="P").on_trigger(lambda _: send(self._push()))

        @self._friction.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(SetFriction(float(event.target.value)))

    def stone(self) -> tuple[float, float]:
        """Height and size [m] of the next stone."""
        return self._height.value * _MM, self._size.value * _MM

    def show(self, snapshot: Snapshot) -> None:
        """Take over the friction at work."""
        if abs(self._friction.value - snapshot.friction) > 1e-9:
            self._friction.value = snapshot.friction

    def _push(self) -> PushNow:
        return PushNow(
            direction_deg=float(self._direction.value), impulse_ns=float(self._impulse.value),
            duration_s=self._duration.value * _MM,
        )  # fmt: skip
