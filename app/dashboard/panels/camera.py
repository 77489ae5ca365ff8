"""Where to look from: each person's own camera."""

from collections.abc import Mapping

import viser

from app.dashboard.panels.narrow import Place, placed_for

CLOSER: Mapping[str, Place] = {
    "foot close-up": ((0.85, 0.75, 0.5), (0.03, 0.04, 0.06)),
    "front": ((3.0, 0.05, 0.95), (0.0, 0.05, 0.85)),
    "side": ((0.0, 3.0, 0.95), (0.0, 0.0, 0.85)),
}


class CameraPanel:
    """A button per place.

    Args:
        gui: where to add it.
        whole: position and target that show the whole robot.
    """

    def __init__(self, gui: viser.GuiApi, whole: Place) -> None:
        places = {"whole robot": whole, **CLOSER}
        buttons = gui.add_button_group("Camera", tuple(places), hint="look from here")

        @buttons.on_click
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:
                position, target = placed_for(places[event.target.value], float(event.client.camera.aspect))
                with event.client.atomic():
                    event.client.camera.position, event.client.camera.look_at = position, target
