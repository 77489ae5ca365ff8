"""Sliders for the figures of sensors, motors and model: they wait for their button, and a seed is typed."""

import dataclasses
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import viser

from surefoot.dashboard.ui.setting_labels import unit_of
from surefoot.dashboard.ui.sliders import add_number, add_slider
from surefoot.dashboard.ui.synced_widget import same, set_changed

_DIGITS = 9  # a slider's sum of steps has dust in its last digits


class Figures:
    """A folder of widgets made from field metadata, and the button that starts with what they hold.

    Args:
        gui: where to add it.
        title: of the folder.
        labels: field -> what the page calls it; where two settings have a field of one name, the first one's is meant.
        settings: dataclasses that have these fields, or instances of them.
        values: field -> what it is now.
        button: its label.
        start: gets what a person has moved, field -> value.
    """

    def __init__(
        self,
        gui: viser.GuiApi,
        title: str,
        labels: Mapping[str, str],
        settings: Iterable[Any],
        values: Mapping[str, float],
        *,
        button: str,
        start: Callable[[Mapping[str, float]], None],
    ) -> None:
        fields = {field.name: field for one in reversed(tuple(settings)) for field in dataclasses.fields(one)}
        self._shown = dict(values)
        with gui.add_folder(title, expand_by_default=False):
            self._widgets = {name: _widget(gui, fields[name], label, values[name]) for name, label in labels.items()}
            handle = gui.add_button(button, hint="the scenario begins again", color="gray")
        handle.on_click(lambda _: start(self._moved()))

    def show(self, values: Mapping[str, float]) -> None:
        """Take over what is at work, only where that has changed: figures may be under a person's hand."""
        if values != self._shown:
            self._shown = dict(values)
            for name, widget in self._widgets.items():
                set_changed(widget, value=float(values[name]))

    def _moved(self) -> Mapping[str, float]:
        """Only what a person has moved: what a slider rounds is to stay as it was."""
        held = {name: round(widget.value, _DIGITS) for name, widget in self._widgets.items()}
        return {name: value for name, value in held.items() if not same(value, self._shown[name])}


def _widget(gui: viser.GuiApi, field: dataclasses.Field, label: str, value: float) -> Any:
    """As the field is described: range, step and help; a count has no slider."""
    meta = field.metadata
    if meta["kind"] == "count":
        return add_number(gui, label, value, 1.0, meta["help"])
    return add_slider(
        gui, f"{label} [{unit_of(field) or '-'}]", meta["low"], meta["high"], meta["step"], value, hint=meta["help"]
    )
