"""The events of a saved run up to an instant, as a list, or above the robot where there is no panel."""

from html import escape

import viser

from surefoot.experiments.runs.saved_run import SavedRun

_LINES, _CAPTION_LINES, _CAPTION_S = 12, 3, 3.0
_CAPTION_AT_M = 1.95  # above Bip


def events_html(run: SavedRun, time_s: float) -> str:
    """The last events up to a time [s], newest first."""
    events = [event for event in run.manifest["events"] if event[0] <= time_s][-_LINES:]
    lines = "".join(f"<div>{float(t):.2f} s {escape(str(text))}</div>" for t, _, text in reversed(events))
    return f'<div role="log" style="font-size:12px;padding:2px 10px;line-height:1.4">{lines}</div>'


class EventCaption:
    """The last events as a label of the scene, for as long as it takes to read them.

    Args:
        server: where to draw.
        run: whose.
        scale: how large the robot is, as a ratio to Bip.
    """

    def __init__(self, server: viser.ViserServer, run: SavedRun, scale: float = 1.0) -> None:
        self._events = run.manifest["events"]
        self._label = server.scene.add_label("/events", " ", position=(0.0, 0.0, scale * _CAPTION_AT_M), visible=False)

    def update(self, time_s: float) -> None:
        """Show what happened just before a time [s]."""
        new = [event for event in self._events if time_s - _CAPTION_S < event[0] <= time_s][-_CAPTION_LINES:]
        text = "\n".join(f"{float(t):.2f} s {words}" for t, _, words in new)
        if text and text != self._label.text:
            self._label.text = text
        if self._label.visible != bool(text):
            self._label.visible = bool(text)
