"""A gain's way from its slider to the controller is short: the files that the value itself passes through."""

import sys
import threading
from pathlib import Path
from typing import Any

from surefoot.dashboard.access.driver_lock import DriverLock
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.ui.setting_widgets import SettingWidgets

PROCESS = "engine/process_worker.py"  # it carries the request to another process; here all is one
# Not on the way to the controller: the notes that are taken of the change, to go back in time and to undo.
BESIDE = {"live/rewind/history.py", "live/undo.py"}
MOST = 11
DEEPEST = 5


class Gain(float):
    """The value: a number that can be told from all others."""


class Browser:
    """A widget, and a person who moves it."""

    def __init__(self) -> None:
        self.moved = {}

    def __getattr__(self, name: str) -> Any:
        def add(label: str, *arguments: Any, **options: Any) -> Any:
            browser = self

            class Handle:
                value = None

                def on_update(self, callback: Any) -> None:
                    browser.moved[label] = callback

            return Handle()

        return add


def carries(thing: Any, depth: int = 0) -> bool:
    """Whether the value is in it, wrapped in messages, lists and tables."""
    if isinstance(thing, Gain):
        return True
    if depth > DEEPEST:
        return False
    if isinstance(thing, dict):
        thing = list(thing.values())
    if isinstance(thing, list | tuple):
        return any(carries(item, depth + 1) for item in thing)
    inside = [getattr(thing, name, None) for name in ("changes", "commands", "command", "led_to")]
    return type(thing).__module__.startswith("surefoot.dashboard") and any(carries(x, depth + 1) for x in inside)


def test_a_gain_passes_few_files_on_its_way_down():
    passed = {}

    def watch(frame: Any, event: str, _: Any) -> None:
        file = frame.f_code.co_filename
        if event != "call" or "/surefoot/dashboard/" not in file:
            return
        count = frame.f_code.co_argcount + frame.f_code.co_kwonlyargcount
        names = [name for name in frame.f_code.co_varnames[:count] if name != "self"]
        if any(carries(frame.f_locals.get(name)) for name in names):
            passed[file.split("/dashboard/")[1]] = None

    arrived = threading.Event()
    browser, playback = Browser(), Playback("stand_left", "two-part")
    session = Session(playback, paced=False)
    lock = DriverLock(session.send, lambda: None)
    SettingWidgets(browser, "gains", playback.live.settings, lock.send)
    moved = next(iter(browser.moved.values()))
    threading.setprofile(watch)
    try:
        session.start()
        event = type("Event", (), {"client": object(), "target": type("Target", (), {"value": Gain(71.25)})})
        sys.setprofile(watch)
        moved(event)
        sys.setprofile(None)
        while "71.25" not in "".join(line.text for line in session.snapshot.events):
            arrived.wait(0.02)
    finally:
        sys.setprofile(None)
        threading.setprofile(None)
        session.stop()
    way = [Path("ui/setting_widgets.py").as_posix(), *passed, PROCESS]
    assert {"access/driver_lock.py", "engine/coordinator.py", "live/handlers/tuning.py"} <= set(way)
    assert len(set(way) - BESIDE) <= MOST, sorted(way)
