"""Sliders and number boxes that take what is typed: with more digits than the slider's steps have."""

import math
from typing import Any

import viser

from surefoot.dashboard.ui.synced_widget import set_changed

_GENTLE = 0.5  # below this share of Bip's, steps are finer
_DIGITS = 6  # of the number box, after the point; hides what floating point adds to 0.3
_DUST = 1e-6  # of a step: what floating point makes of a whole number of them


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


def add_number(gui: viser.GuiApi, label: str, value: float, step: float, hint: str) -> viser.GuiNumberHandle[float]:
    """A number box without a slider, which takes what is typed; whoever is sent it knows which numbers are valid.

    With digits from the step, as viser would have it, a weight of 0.0015 lost its last; and a number that begins as a
    whole one stays one: 12.5 steps became 12.

    Args:
        gui: where to add it.
        label: beside it.
        value: the first one.
        step: of its arrows.
        hint: its tooltip.
    """
    handle = gui.add_number(label, float(value), step=float(step), hint=hint)
    handle.precision = _DIGITS
    return handle


def set_range(handle: viser.GuiSliderHandle[float], low: float, high: float, step: float) -> None:
    """Give a slider other ends and steps; its value stays: it may be what is active."""
    set_changed(handle, min=float(low), max=float(high), step=float(step))


def scaled_range(low: float, high: float, step: float, ratio: float) -> tuple[float, float, float]:
    """Ends and steps of a slider for a robot of another size.

    Args:
        low: end for Bip.
        high: the other one.
        step: for Bip.
        ratio: of what the slider is about, to Bip's.

    Returns:
        The ends to two digits, and a tenth of the step where the ratio is below a half; unchanged where it is 1.
    """
    if ratio == 1.0:
        return low, high, step
    return float(f"{ratio * low:.2g}"), float(f"{ratio * high:.2g}"), step if ratio >= _GENTLE else 0.1 * step


def steps_within(low: float, high: float, step: float, ratio: float) -> tuple[float, float, float]:
    """Ends of a slider that are whole steps within a robot's own range, and its step.

    Args:
        low: least value that the robot takes.
        high: the greatest.
        step: for Bip.
        ratio: of what the slider is about, to Bip's: below a half the step is a tenth.
    """
    step = step if ratio >= _GENTLE else 0.1 * step
    ends = step * math.ceil(low / step - _DUST), step * math.floor(high / step + _DUST)
    return round(ends[0], _DIGITS), round(ends[1], _DIGITS), step
