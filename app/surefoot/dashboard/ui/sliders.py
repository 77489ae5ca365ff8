"""Sliders whose number box takes what is typed: with more digits than the slider's steps have."""

from typing import Any

import viser

_DIGITS = 6  # of the number box, after the point; hides what floating point adds to 0.3


def add_slider(
    gui: viser.GuiApi, label: str, low: float, high: float, step: float, value: float, **options: Any
) -> viser.GuiSliderHandle[float]:
    """A slider of floats.

    Viser derives the digits of the box beside a slider from the slider's step, and makes a slider of whole numbers
    where all it is given are whole: then 12.5 would become 125.

    Args:
        gui: where to add it.
        label: beside it.
        low: least value.
        high: greatest value.
        step: of the slider; the box takes values between steps.
        value: the first one.
        options: ``hint``, ``marks`` and ``visible`` of ``gui.add_slider``.
    """
    handle = gui.add_slider(label, float(low), float(high), float(step), float(value), **options)
    handle.precision = _DIGITS
    return handle
