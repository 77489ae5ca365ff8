"""The coloured ranges of the delta_P reference: where a value is admissible, where it stands, what it will do."""

from surefoot.dashboard.messages.snapshot import BiasView
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.setting_widgets import fields_of

_RANGES = {field.name: (field.metadata["low"], field.metadata["high"]) for field in fields_of("delta")}


def bias_html(bias: BiasView) -> str:
    """Two bars over the sliders' whole range: green where admissible, with a mark at the value, and the prediction."""
    frontal, sagittal = bias.reference_nm
    forward, left = bias.displacement_mm
    return (
        '<div style="padding:4px 10px;font-size:12px;line-height:1.6;color:inherit">'
        f"{_bar('sagittal', sagittal, bias.sagittal_nm, 'delta_ref_sagittal_nm')}"
        f"{_bar('frontal', frontal, bias.frontal_nm, 'delta_ref_frontal_nm')}"
        f'<div title="where the CoM comes to rest, from gains and the whole body\'s inertia">predicted CoM shift: '
        f"forward {forward:+.1f} mm, left {left:+.1f} mm</div></div>"
    )


def _bar(name: str, value: float, interval: tuple[float, float] | None, field: str) -> str:
    low, high = _RANGES[field]

    def place(x: float) -> float:
        return 100.0 * (min(max(x, low), high) - low) / (high - low)

    if interval is None:
        return f"<div>δ_P ref {name}: no admissible range in this posture</div>"
    start, end = place(interval[0]), place(interval[1])
    inside = interval[0] <= value <= interval[1]
    mark = palette.GOOD if inside else palette.BAD
    return (
        f"<div>δ_P ref {name}: admissible {interval[0]:.0f} to {interval[1]:.0f} N·m</div>"
        f'<div style="position:relative;height:8px;border-radius:4px;background:{palette.BAD}55">'
        f'<div style="position:absolute;left:{start:.1f}%;width:{end - start:.1f}%;height:8px;'
        f'background:{palette.GOOD}99"></div>'
        f'<div style="position:absolute;left:calc({place(value):.1f}% - 2px);top:-2px;width:4px;height:12px;'
        f'background:{mark};border:1px solid #fff"></div></div>'
    )
