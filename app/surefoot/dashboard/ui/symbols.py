"""The signs of the theory's points: one for each, the same in the plan of the feet, in the legend and in the scene."""

from surefoot.dashboard.ui import palette

COLOURS = {
    "zmp": palette.ZMP_MEASURED, "command": palette.ZMP_COMMANDED, "com": palette.COM, "capture": palette.CAPTURE,
}  # fmt: skip
_HALO = 'stroke="#fff" stroke-opacity="0.85" stroke-width="1"'


def mark(key: str, x: float, y: float) -> str:
    """SVG of a sign at a place [pixels]: a disc, a ring, a quartered disc or a diamond."""
    colour = palette.css(COLOURS[key])
    at = f'transform="translate({x:.1f} {y:.1f})"'
    if key == "zmp":
        return f'<circle {at} r="5" fill="{colour}" {_HALO}/>'
    if key == "command":
        return f'<circle {at} r="8" fill="none" stroke="{colour}" stroke-width="2.6"/>'
    if key == "capture":
        return f'<path {at} d="M0 -6.5L6.5 0L0 6.5L-6.5 0Z" fill="{colour}" {_HALO}/>'
    return (
        f'<g {at}><circle r="6" fill="#fff"/><path d="M0 0V-6A6 6 0 0 1 6 0ZM0 0V6A6 6 0 0 1 -6 0Z" fill="{colour}"/>'
        f'<circle r="6" fill="none" stroke="{colour}" stroke-width="1.6"/></g>'
    )


def sign(key: str, size: int = 18) -> str:
    """The sign alone, to stand in a line of text."""
    return (
        f'<svg width="{size}" height="{size}" viewBox="-10 -10 20 20" style="vertical-align:-4px;flex:none">'
        f"{mark(key, 0.0, 0.0)}</svg>"
    )
