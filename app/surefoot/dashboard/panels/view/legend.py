"""What to draw: a checkbox per marker, with its colour and its meaning."""

import viser

from surefoot.dashboard.panels.page_context import ViewContext
from surefoot.dashboard.scene.markers import OVERLAYS, OverlayKind
from surefoot.dashboard.scene.scene import SEE_THROUGH
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.symbols import COLOURS, sign


class LegendPanel:
    """Checkboxes and legend of the markers.

    Args:
        context: of the page, or of a replay's.
    """

    def __init__(self, context: ViewContext) -> None:
        gui = context.gui
        rows = "".join(
            f'<div style="margin:3px 0">{_sign(kind)} <b>{kind.label}</b>: {kind.help}</div>' for kind in OVERLAYS
        )
        for kind in OVERLAYS:
            box = gui.add_checkbox(f"{kind.symbol} {kind.label}", True, hint=kind.help)

            def changed(event: viser.GuiEvent, key: str = kind.key) -> None:
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


def _sign(kind: OverlayKind) -> str:
    """The sign as it is drawn in the scene and in the plan of the feet."""
    if kind.key in COLOURS:
        return sign(kind.key)
    return f'<span style="color:{palette.css(kind.colour)};font-size:15px">{kind.symbol}</span>'
