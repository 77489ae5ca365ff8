"""Where to look from: each person's own camera."""

from collections.abc import Mapping
from typing import Literal

import viser

from surefoot.dashboard.panels.panel import ViewContext
from surefoot.dashboard.scene.scene import CAMERA_LOOK_AT, CAMERA_POSITION
from surefoot.dashboard.ui.mobile_layout import Place, placed_for

CLOSER: Mapping[str, Place] = {
    "foot close-up": ((0.85, 0.75, 0.5), (0.03, 0.04, 0.06)),
    "front": ((3.0, 0.05, 0.95), (0.0, 0.05, 0.85)),
    "side": ((0.0, 3.0, 0.95), (0.0, 0.0, 0.85)),
}
# not W, A, S, D, Q, E: with these viser moves the camera
_KEYS: tuple[Literal["O", "F", "V", "L"], ...] = ("O", "F", "V", "L")


def add_camera(context: ViewContext) -> None:
    """Add a button and a key per place."""
    gui = context.gui
    places = {"whole robot": (CAMERA_POSITION, CAMERA_LOOK_AT), **CLOSER}
    keys = ", ".join(f"{key} = {name}" for key, name in zip(_KEYS, places, strict=True))
    buttons = gui.add_button_group("Camera", tuple(places), hint=f"look from here; keys: {keys}")

    @buttons.on_click
    def _(event: viser.GuiEvent) -> None:
        if event.client is not None:
            look_from(event.client, places[event.target.value])

    for key, (name, place) in zip(_KEYS, places.items(), strict=True):
        gui.add_command(f"Camera: {name}", hotkey=key).on_trigger(
            lambda event, place=place: look_from(event.client, place) if event.client is not None else None
        )


def look_from(client: viser.ClientHandle, place: Place) -> None:
    """Move one person's camera."""
    position, target = placed_for(place, float(client.camera.aspect))
    with client.atomic():
        client.camera.position, client.camera.look_at = position, target
