"""Settings as TOML files: the ``[controller]`` table of a scenario. Some come with the program: ``static/presets``."""

import dataclasses
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.field_metadata import from_mapping
from surefoot.resources import resource_folder

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
        text = content.decode("utf-8").partition("\n")[0].lstrip("# ").rstrip()
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
        InvalidInput: not TOML, without the table, or a setting or value that there is not; says which there are.
    """
    if len(content) > _LARGEST_BYTES:
        raise InvalidInput(source, f"{len(content)} bytes", "is too large", [f"up to {_LARGEST_BYTES} bytes"])
    try:
        tables = tomllib.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise InvalidInput(
            source, "...", f"is not valid TOML: {error}", ["[controller]", "com_stiffness = 60.0"]
        ) from None
    table = tables.get("controller")
    if not isinstance(table, dict) or not table:
        raise InvalidInput(source, list(tables), "has no table [controller] with settings in it", _FIELDS)
    try:
        from_mapping(ControllerSettings, table, "controller")
    except InvalidInput as error:
        raise InvalidInput(f"{source}: {error.field}", error.value, error.reason, error.valid) from None
    return table
