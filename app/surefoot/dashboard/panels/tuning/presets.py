"""Whole sets of settings: those that come with the program, and TOML files to keep, to share, to load again.

A file is the ``[controller]`` table of a scenario. Those of the program are in ``static/presets``.
"""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from typing import Any

import viser

from surefoot.control.settings import ControllerSettings, settings_differences
from surefoot.dashboard.messages.commands import UseSettings
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext
from surefoot.dashboard.ui.setting_labels import difference_text
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.errors import InvalidInput
from surefoot.field_metadata import from_mapping, with_current_names
from surefoot.resources import resource_folder
from surefoot.text_files import text_of, toml_of

_LARGEST_BYTES = 100_000
_FIELDS = [field.name for field in dataclasses.fields(ControllerSettings)]


@dataclass(frozen=True)
class Preset:
    """A named set of settings.

    Attributes:
        name: of the file.
        text: one line: what it is for.
        settings: field -> value; what is not named stays as scenario and controller have it.
    """

    name: str
    text: str
    settings: Mapping[str, Any]


def shipped_presets() -> dict[str, Preset]:
    """The presets that come with the program, by name; the first comment of a file says what it is for."""
    found = {}
    for path in sorted((resource_folder("static") / "presets").glob("*.toml")):
        content = path.read_bytes()
        text = text_of(content, "preset", path.name).partition("\n")[0].lstrip("# ").rstrip()
        found[path.stem] = Preset(path.stem, text, read_preset(content, f"preset {path.name}"))
    return found


def preset_text(controller: str, settings: ControllerSettings) -> str:
    """Settings as the ``[controller]`` table of a scenario."""
    lines = [f"# Surefoot settings, saved while {controller} was at work.", "[controller]"]
    for name, value in dataclasses.asdict(settings).items():
        lines.append(f"{name} = {str(value).lower() if isinstance(value, bool) else repr(value)}")
    return "\n".join(lines) + "\n"


def read_preset(content: bytes, source: str = "settings file") -> dict[str, Any]:
    """The table of such a file, every value of it valid.

    Raises:
        InvalidInput: no TOML in UTF-8, no such table, or a setting or value that there is not (says which there are).
    """
    text = text_of(content, source, f"{len(content)} bytes", largest=_LARGEST_BYTES)
    tables = toml_of(text, source, "...", valid=["[controller]", "com_stiffness = 60.0"])
    table = tables.get("controller")
    if not isinstance(table, dict) or not table:
        raise InvalidInput(source, list(tables), "has no table [controller] with settings in it", _FIELDS)
    try:
        from_mapping(ControllerSettings, table, "controller")
    except InvalidInput as error:
        raise InvalidInput(f"{source}: {error.field}", error.value, error.reason, error.valid) from None
    return with_current_names(ControllerSettings, table)


_SHOWN = 8


class PresetPanel:
    """Choose, save and load.

    Args:
        context: of the page.
        presets: those that come with the program, by name.
    """

    def __init__(self, context: PageContext, presets: Mapping[str, Preset]) -> None:
        gui, send, newest = context.gui, context.send, context.newest
        self._presets = presets
        self._choice = gui.add_dropdown(
            "Preset",
            tuple(presets),
            hint=(
                "sets of settings that come with the program; what a preset does not name is as scenario and "
                "controller have it. Choosing shows what it would change, the button makes it so"
            ),
        )
        self._text = gui.add_html("")
        use = gui.add_button("Use this preset", hint="a single step, so that it can be undone", color="gray")
        save = gui.add_button(
            "Save settings", color="gray", hint="as a TOML file; its [controller] table fits into a scenario"
        )
        load = gui.add_upload_button(
            "Load settings",
            mime_type=".toml",
            color="gray",
            hint="a TOML file with a [controller] table; what it does not name is as scenario and controller have it",
        )
        self.show(newest())

        @self._choice.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                self.show(newest())

        @use.on_click
        def _(_: viser.GuiEvent) -> None:
            preset = presets[self._choice.value]
            send(UseSettings(settings=preset.settings, label=f"preset {preset.name}"))

        @save.on_click
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:
                snapshot = newest()
                text = preset_text(snapshot.controller, snapshot.settings)
                event.client.send_file_download(f"surefoot-{snapshot.controller}.toml", text.encode())

        @load.on_upload
        def _(event: viser.GuiEvent) -> None:
            file = event.target.value
            try:
                send(UseSettings(settings=read_preset(file.content), label=f"file {file.name}"))
            except InvalidInput as error:
                if event.client is not None:
                    event.client.add_notification("Settings were not loaded", str(error), color="red")

    def show(self, snapshot: Snapshot) -> None:
        """Say what the chosen preset would change."""
        set_changed(self._text, content=preset_html(self._presets[self._choice.value], snapshot))


def preset_html(preset: Preset, snapshot: Snapshot) -> str:
    """What a preset is for, what of it differs from the defaults, and whether it is active."""
    defaults = snapshot.tuning.defaults
    wanted = ControllerSettings(**{**vars(defaults), **preset.settings})
    changed = [difference_text(*difference, unit=True) for difference in settings_differences(defaults, wanted)]
    rows = "".join(f"<div>{escape(text)}</div>" for text in changed[:_SHOWN])
    more = f"<div>and {len(changed) - _SHOWN} more</div>" if len(changed) > _SHOWN else ""
    if wanted == snapshot.settings:
        state = "<b>at work now</b>"
    else:
        state = f"differs from the defaults in {len(changed)}:" if changed else "the defaults of this controller"
    return (
        '<div aria-label="What the preset changes" '
        'style="padding:0 10px 4px;font-size:12px;line-height:1.35;color:inherit">'
        f"{escape(preset.text)}<div style='opacity:0.75'>{state}{rows}{more}</div></div>"
    )
