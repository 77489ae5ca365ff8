"""What to draw: a checkbox per marker, with its colour and its meaning."""

import viser

from surefoot.dashboard.panels.panel import ViewContext
from surefoot.dashboard.scene.markers.marker import Marker
from surefoot.dashboard.scene.markers.markers import MARKERS
from surefoot.dashboard.scene.scene import SEE_THROUGH
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.symbols import BY_KEY, sign


class LegendPanel:
    """Checkboxes and legend of the markers.

    Args:
        context: of the page, or of a replay's.
    """

    def __init__(self, context: ViewContext) -> None:
        gui = context.gui
        rows = "".join(
            f'<div style="margin:3px 0">{_sign(marker)} <b>{marker.label}</b>: {marker.help}</div>'
            for marker in MARKERS
        )
        for marker in MARKERS:
            box = gui.add_checkbox(f"{marker.symbol} {marker.label}", marker.shown_at_first, hint=marker.help)

            def changed(event: viser.GuiEvent, key: str = marker.key) -> None:
                context.show_marker(key, event.target.value)

            box.on_update(changed)
        theme = gui.add_checkbox("Dark page", False, hint="dark or light colours")

        @theme.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                context.set_dark(event.target.value)

        through = gui.add_dropdown(
            "See through", SEE_THROUGH, hint="the sole and the ZMP lie below the foot, the CoM inside the trunk"
        )

        @through.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                context.see_through(event.target.value)

        with gui.add_folder("Legend"):
            gui.add_html(f'<div style="font-size:12px;padding:2px 10px">{rows}</div>')


def _sign(marker: type[Marker]) -> str:
    """The sign as it is drawn in the scene and in the plan of the feet."""
    if marker.key in BY_KEY:
        return sign(BY_KEY[marker.key])
    return f'<span style="color:{palette.css(marker.colour)};font-size:15px">{marker.symbol}</span>'
