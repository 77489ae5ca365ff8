"""``surefoot settings``: the controllers and estimators there are, and every setting of them and the plant."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True)
class Settings:
    """Print the controllers and estimators, and every setting of them and of the plant with range, unit and help."""

    def main(self) -> None:
        """Print it."""
        from rich.console import Console
        from rich.markup import escape
        from rich.table import Table

        from surefoot.control.registry import controllers, unavailable_controllers
        from surefoot.control.settings import ControllerSettings
        from surefoot.estimation.registry import estimators, unavailable_estimators
        from surefoot.estimation.settings import EstimatorSettings
        from surefoot.simulation.model_error import MODEL_ERROR_PRESETS, ModelErrorSettings
        from surefoot.simulation.motors import MOTOR_PRESETS, MotorSettings
        from surefoot.simulation.sensors.settings import SENSOR_PRESETS, SensorSettings

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
        listing = Table("estimator", "help")
        for name, entry in estimators().items():
            listing.add_row(name, escape(entry.help))
        for name, reason in unavailable_estimators().items():
            listing.add_row(f"{escape(name)} [red](not available)[/]", escape(reason))
        console.print(listing)
        table = Table("estimator", "default", "valid", "help")
        for setting in fields(EstimatorSettings):
            if "kind" in setting.metadata:  # the name has the list above
                table.add_row(setting.name, str(setting.default), _valid(setting.metadata), setting.metadata["help"])
        console.print(table)
        for title, cls, presets in (
            ("sensors", SensorSettings, SENSOR_PRESETS),
            ("motors", MotorSettings, MOTOR_PRESETS),
            ("model_error", ModelErrorSettings, MODEL_ERROR_PRESETS),
        ):
            table = Table(title, *presets, "valid", "help")
            for setting in fields(cls):
                values = (f"{preset[setting.name]:g}" if setting.name in preset else "" for preset in presets.values())
                table.add_row(setting.name, *values, _valid(setting.metadata), setting.metadata["help"])
            console.print(table)


def _valid(meta: Mapping[str, Any]) -> str:
    if meta["kind"] == "number":
        return f"{meta['low']:g} to {meta['high']:g} {meta['unit']}".strip()
    if meta["kind"] == "count":
        return f"{meta['low']} to {meta['high']}"
    return ", ".join(meta.get("valid", ("true", "false")))


def _help(meta: Mapping[str, Any]) -> str:
    return f"{meta['help']}. Raised: {meta['raised']}" if meta.get("raised") else meta["help"]
