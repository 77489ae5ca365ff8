"""Settings as a file: the ``[controller]`` table of a scenario, to keep, to share, to load again."""

import dataclasses
import tomllib
from collections.abc import Callable
from typing import Any

import viser

from app.control.settings import ControllerSettings
from app.dashboard.commands import ChangeSettings
from app.dashboard.panels.fields import Send
from app.dashboard.snapshot import Snapshot
from app.errors import InvalidInput

_LARGEST_BYTES = 100_000


class PresetPanel:
    """Save and load.

    Args:
        gui: where to add it.
        send: takes the commands.
        newest: gives the newest snapshot.
    """

    def __init__(self, gui: viser.GuiApi, send: Send, newest: Callable[[], Snapshot]) -> None:
        save = gui.add_button("Save settings", hint="as a TOML file; its [controller] table fits into a scenario")
        load = gui.add_upload_button("Load settings", mime_type=".toml", hint="a TOML file with a [controller] table")

        @save.on_click
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:
                snapshot = newest()
                text = preset_text(snapshot.controller, snapshot.settings)
                event.client.send_file_download(f"surefoot-{snapshot.controller}.toml", text.encode())

        @load.on_upload
        def _(event: viser.GuiEvent) -> None:
            try:
                send(ChangeSettings(read_preset(event.target.value.content)))
            except InvalidInput as error:
                if event.client is not None:
                    event.client.add_notification("Settings were not loaded", str(error), color="red")


def preset_text(controller: str, settings: ControllerSettings) -> str:
    """Settings as the ``[controller]`` table of a scenario."""
    lines = [f"# Surefoot settings, saved while {controller} was at work.", "[controller]"]
    for name, value in dataclasses.asdict(settings).items():
        lines.append(f"{name} = {str(value).lower() if isinstance(value, bool) else repr(value)}")
    return "\n".join(lines) + "\n"


def read_preset(content: bytes) -> dict[str, Any]:
    """The table of such a file. Raises InvalidInput."""
    if len(content) > _LARGEST_BYTES:
        raise InvalidInput("settings file", f"{len(content)} bytes", "is too large", [f"up to {_LARGEST_BYTES} bytes"])
    try:
        table = tomllib.loads(content.decode("utf-8")).get("controller")
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise InvalidInput("settings file", "...", f"is not valid TOML: {error}") from None
    if not isinstance(table, dict) or not table:
        raise InvalidInput("settings file", "...", "has no table [controller]")
    return table
