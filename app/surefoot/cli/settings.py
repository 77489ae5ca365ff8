"""``surefoot settings``: every gain and switch of the controllers, as a table."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True)
class Settings:
    """Print every gain and switch of the controllers with range, unit, equation and help."""

    def main(self) -> None:
        """Print it."""
        from rich.console import Console
        from rich.table import Table

        from surefoot.control.settings import ControllerSettings

        table = Table("setting", "default", "valid", "equation", "help")
        for setting in fields(ControllerSettings):
            meta = setting.metadata
            table.add_row(setting.name, str(setting.default), _valid(meta), meta["equation"], _help(meta))
        Console().print(table)


def _valid(meta: Mapping[str, Any]) -> str:
    if meta["kind"] == "number":
        return f"{meta['low']:g} to {meta['high']:g} {meta['unit']}".strip()
    return ", ".join(meta.get("valid", ("true", "false")))


def _help(meta: Mapping[str, Any]) -> str:
    return f"{meta['help']}. Raised: {meta['raised']}" if meta.get("raised") else meta["help"]
