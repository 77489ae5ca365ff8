"""Where to look from: each person's own camera."""

from collections.abc import Mapping
from typing import Literal

import viser

from surefoot.dashboard.panels.panel import ViewContext
from surefoot.dashboard.scene.scene import WHOLE_ROBOT
from surefoot.dashboard.ui.mobile_layout import Place

CLOSER: Mapping[str, Place] = {
    "foot close-up": ((0.85, 0.75, 0.5), (0.03, 0.04, 0.06)),
    "front": ((3.0, 0.05, 0.95), (0.0, 0.05, 0.85)),
    "side": ((0.0, 3.0, 0.95), (0.0, 0.0, 0.85)),
}
# not W, A, S, D, Q, E: with these viser moves the camera
_KEYS: tuple[Literal["O", "F", "V", "L"], ...] = ("O", "F", "V", "L")


def add_camera(context: ViewContext) -> None:
    """Add a button and a key per place, and each person's own choice whether to follow the robot."""
    gui, cameras = context.gui, context.cameras
    places = {"whole robot": WHOLE_ROBOT, **CLOSER}
    keys = ", ".join(f"{key} = {name}" for key, name in zip(_KEYS, places, strict=True))
    buttons = gui.add_button_group("Camera", tuple(places), hint=f"look from here; keys: {keys}")

    @buttons.on_click
    def _(event: viser.GuiEvent) -> None:
        if event.client is not None:
            cameras.look_from(event.client, places[event.target.value])

    for key, (name, place) in zip(_KEYS, places.items(), strict=True):
        gui.add_command(f"Camera: {name}", hotkey=key).on_trigger(
            lambda event, place=place: cameras.look_from(event.client, place) if event.client is not None else None
        )
    own = gui.add_folder(None)  # keeps the place of what only one person sees

    @context.server.on_client_connect
    async def _(client: viser.ClientHandle) -> None:
        with own:
            follow = client.gui.add_checkbox(
                "Follow the robot", True, hint="your camera goes where a robot goes that walks; only yours"
            )

        @follow.on_update
        def _(event: viser.GuiEvent) -> None:
            cameras.set_follows(client, event.target.value)
