"""Widgets made from field metadata: range, unit, choices and help are written once, in ``ControllerSettings``."""

import dataclasses
from collections.abc import Callable
from typing import Any

import viser

from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.messages.commands import ChangeSettings, Command
from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.ui.setting_labels import help_of, hint_of, label_of
from surefoot.dashboard.ui.sliders import add_number, add_slider, scaled_range, set_range
from surefoot.dashboard.ui.synced_widget import SyncedWidget, set_changed

Send = Callable[[Command], None]
_MOMENT = "N m"  # unit of the settings that go with the size of a robot


def from_browser(event: viser.GuiEvent) -> bool:
    """Whether a person did it (the page's own updates of a widget come without a client)."""
    return event.client is not None


def fields_of(group: str) -> list[dataclasses.Field]:
    """The described fields of one group, in order."""
    return [field for field in dataclasses.fields(ControllerSettings) if field.metadata.get("group") == group]


class SettingWidgets:
    """The widgets of one or more groups, kept equal to the active settings.

    Args:
        gui: where to add them (into the current container).
        group: which fields.
        settings: what they show first.
        send: takes the commands.
        explain: write the help below each widget too, not only into its tooltip.
    """

    def __init__(
        self, gui: viser.GuiApi, group: str, settings: ControllerSettings, send: Send, *, explain: bool = False
    ) -> None:
        self._followers: dict[str, SyncedWidget] = {}
        self._moments: list[tuple[dataclasses.Field, viser.GuiSliderHandle[float]]] = []
        for field in fields_of(group):
            handle = _widget(gui, field, getattr(settings, field.name))
            if field.metadata.get("unit") == _MOMENT:
                self._moments.append((field, handle))
            self._followers[field.name] = SyncedWidget(handle)
            handle.on_update(_sender(field.name, send))
            if explain:
                gui.add_markdown(f"<small>{help_of(field)}</small>")

    def suit(self, robot: ShownRobot) -> None:
        """Ranges of moments go with the robot."""
        for field, slider in self._moments:
            low, high, step = range_shown(field, robot)
            set_range(slider, low, high, step)
            set_changed(slider, hint=hint_of(field, (low, high)))

    def show(self, settings: ControllerSettings) -> None:
        """Take over the active settings."""
        for name, follower in self._followers.items():
            follower.show(getattr(settings, name))


def range_shown(field: dataclasses.Field, robot: ShownRobot) -> tuple[float, float, float]:
    """Ends and steps of the slider of a number: a moment's are in proportion to the robot."""
    meta = field.metadata
    return scaled_range(meta["low"], meta["high"], meta["step"], robot.moment if meta["unit"] == _MOMENT else 1.0)


def _widget(gui: viser.GuiApi, field: dataclasses.Field, value: Any) -> Any:
    meta, label, hint = field.metadata, label_of(field), hint_of(field)
    if meta["kind"] == "switch":
        return gui.add_checkbox(label, value, hint=hint)
    if meta["kind"] == "choice":
        return gui.add_dropdown(label, meta["valid"], initial_value=value, hint=hint)
    if meta["low"] > 0.0 and meta["high"] / meta["low"] >= 1e5:  # decades: a slider would be useless
        # no ``min`` and ``max``: the browser would put what is out of range to the nearest end of it, unasked; the
        # session refuses it and says what is valid
        return add_number(gui, label, value, meta["low"], hint)
    return add_slider(gui, label, meta["low"], meta["high"], meta["step"], value, hint=hint)


def _sender(name: str, send: Send) -> Callable[[viser.GuiEvent], None]:
    def changed(event: viser.GuiEvent) -> None:
        if from_browser(event):
            send(ChangeSettings({name: event.target.value}))

    return changed
