"""What to draw: a checkbox per marker, with its colour and its meaning."""

from collections.abc import Callable

import viser

from surefoot.dashboard.scene.markers import OVERLAYS, OverlayKind
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.symbols import COLOURS, sign


class LegendPanel:
    """Checkboxes and legend of the markers.

    Args:
        gui: where to add it.
        show: called with a marker's key and whether it is visible.
        dark: called with whether the page is dark.
        clear: called with what is see-through.
        parts: what can be.
    """

    def __init__(
        self, gui: viser.GuiApi, show: Callable[[str, bool], None], dark: Callable[[bool], None],
        clear: Callable[[str], None], parts: tuple[str, ...],
    ) -> None:  # fmt: skip
        rows = "".join(
            f'<div style="margin:3px 0">{_sign(kind)} <b>{kind.label}</b>: {kind.help}</div>' for kind in OVERLAYS
        )
        for kind in OVERLAYS:
            box = gui.add_checkbox(f"{kind.symbol} {kind.label}", True, hint=kind.help)

            def changed(event: viser.GuiEvent, key: str = kind.key) -> None:
                show(key, event.target.value)

            box.on_update(changed)
        theme = gui.add_checkbox("Dark page", False, hint="dark or light colours")

        @theme.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                dark(event.target.value)

        through = gui.add_dropdown("See through", parts, hint="the sole and the ZMP lie below the foot, the CoM inside "
                                   "the trunk")  # fmt: skip

        @through.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                clear(event.target.value)

        with gui.add_folder("Legend"):
            gui.add_html(f'<div style="font-size:12px;padding:2px 10px">{rows}</div>')


def _sign(kind: OverlayKind) -> str:
    """The sign as it is drawn in the scene and in the plan of the feet."""
    if kind.key in COLOURS:
        return sign(kind.key)
    return f'<span style="color:{palette.css(kind.colour)};font-size:15px">{kind.symbol}</span>'
