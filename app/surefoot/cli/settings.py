"""``surefoot settings``: the controllers there are, and every gain and switch of them, as tables."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True)
class Settings:
    """Print the controllers, and every gain and switch of them with range, unit, equation and help."""

    def main(self) -> None:
        """Print it."""
        from rich.console import Console
        from rich.markup import escape
        from rich.table import Table

        from surefoot.control.registry import controllers, unavailable_controllers
        from surefoot.control.settings import ControllerSettings

        console, listing = Console(), Table("controller", "help")
        for name, entry in controllers().items():
            listing.add_row(name, escape(entry.help))
        for name, reason in unavailable_controllers().items():
            listing.add_row(f"{escape(name)} [red](not available)[/]", escape(reason))
        console.print(listing)
        table = Table("setting", "default", "valid", "equation", "help")
        for setting in fields(ControllerSettings):
            meta = setting.metadata
            table.add_row(setting.name, str(setting.default), _valid(meta), meta["equation"], _help(meta))
        console.print(table)


def _valid(meta: Mapping[str, Any]) -> str:
    if meta["kind"] == "number":
        return f"{meta['low']:g} to {meta['high']:g} {meta['unit']}".strip()
    return ", ".join(meta.get("valid", ("true", "false")))


def _help(meta: Mapping[str, Any]) -> str:
    return f"{meta['help']}. Raised: {meta['raised']}" if meta.get("raised") else meta["help"]
