"""Keep and share: the last seconds as a file, a page that replays them, a picture, a link."""

from html import escape

import viser

from surefoot.dashboard.messages.run_link import link_query
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.export.run_files import file_name, png_bytes, run_bytes
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.experiments.scenario.robots import is_robot_file

_DATA = {"Parquet": "parquet", "NPZ": "npz", "MCAP": "mcap"}
_PATIENCE_S = 60.0
_NO_ANSWER = "The simulation did not answer: try again."
_MOST_PIXELS = 1920
_OWN_ROBOT = (
    "No link can name this robot: it is a file on this computer. Give the file itself to others, who start the page "
    "with --robot FILE."
)


class ExportPanel(Panel):
    """Buttons, each of which gives the person who presses it a file.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, self._ask, self._address = context.gui, context.saved_run, context.address
        gui.add_markdown(
            "<small>The last 30 s of this run, every millisecond, with what made it: scenario, "
            "controller, settings, stones, versions.</small>"
        )
        data = gui.add_button_group(
            "Data", tuple(_DATA), hint="Parquet and NPZ open again with surefoot replay; MCAP opens in Foxglove"
        )
        page = gui.add_button("Replay page (HTML)", hint="one file that opens from disk: the scene, with a time bar")
        picture = gui.add_button("Picture (PNG)", hint="the scene as you see it")
        with gui.add_folder("Link"):
            gui.add_markdown(
                "<small>Scenario, robot, controller and changed values (no stones of yours). Who opens it "
                "restarts the run for everybody on this page.</small>"
            )
            self._link = gui.add_html("")
        self._linked: tuple | None = None

        data.on_click(lambda event: self._give(event, _DATA[event.target.value]))
        page.on_click(lambda event: self._give(event, "html"))
        picture.on_click(_picture)

    def show(self, snapshot: Snapshot) -> None:
        """Take over what the link has to say."""
        shown = (
            snapshot.scenario,
            snapshot.robot,
            snapshot.changes,
            snapshot.controller,
            snapshot.settings,
            snapshot.friction,
        )
        if shown != self._linked:
            self._linked = shown
            self._link.content = self._link_html(link_query(snapshot), is_robot_file(snapshot.robot.key))

    def _give(self, event: viser.GuiEvent, suffix: str) -> None:
        client = event.client
        if client is None:
            return
        try:
            run = self._ask().result(timeout=_PATIENCE_S)
            client.send_file_download(file_name(run, suffix), run_bytes(run, suffix), save_immediately=True)
        except Exception as error:  # the person has to know; viser would only print it
            client.add_notification("Nothing was saved", str(error) or _NO_ANSWER, color="red")

    def _link_html(self, query: str | None, own_robot: bool) -> str:
        style = 'style="padding:2px 10px 8px;font-size:12px;line-height:1.4;overflow-wrap:anywhere;user-select:all"'
        if own_robot:
            return f"<div {style}>{_OWN_ROBOT}</div>"
        if query is None:
            return f"<div {style}>No link can name this scenario: a file of yours, or too much of it was changed.</div>"
        address = escape(f"{self._address}/?{query}")
        return f'<div {style}><a href="{address}" target="_blank">{address}</a></div>'


def _picture(event: viser.GuiEvent) -> None:
    client = event.client
    if client is None:
        return
    try:
        width, height = client.camera.image_width, client.camera.image_height
        scale = min(1.0, _MOST_PIXELS / max(width, height, 1))
        pixels = client.get_render(round(height * scale), round(width * scale), timeout=_PATIENCE_S)
        if pixels.size == 0 or pixels.min() == pixels.max():
            raise RuntimeError("this browser draws no 3D view")
        client.send_file_download("surefoot.png", png_bytes(pixels), save_immediately=True)
    except (RuntimeError, TimeoutError) as error:
        client.add_notification("No picture", str(error), color="red")
