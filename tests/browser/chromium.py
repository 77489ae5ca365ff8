"""One Chromium for all tests of this folder, and how it is started."""

import os
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

# Drawn by software: WebGL by SwiftShader, unsmoothed; the rest of the page on the processor at once, and not by an
# imitated GPU, as Debian's Chromium would otherwise be told to. One picture takes a fifth of the time.
ARGUMENTS = (
    "--no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --disable-gpu-rasterization "
    "--webgl-antialiasing-mode=none --disable-quic --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync"
).split()


class Chromium:
    """Starts browsers when they are first asked for; their pages have nothing in common."""

    def __init__(self) -> None:
        self._playwright = self._folder = None
        self._browsers = {}

    def started(self, path: str, arguments: Sequence[str]):
        """Playwright's browser: the program at a path with these arguments."""
        from playwright.sync_api import sync_playwright

        if self._playwright is None:
            self._playwright = sync_playwright().start()
            self._folder = tempfile.TemporaryDirectory()
        key = path, *arguments
        if key not in self._browsers or not self._browsers[key].is_connected():  # one may have crashed
            program = without_priority(path, Path(self._folder.name))
            self._browsers[key] = self._playwright.chromium.launch(executable_path=program, args=list(arguments))
        return self._browsers[key]

    def close(self) -> None:
        """Close what was started. Until then Playwright's event loop runs in this thread, and no other can."""
        for browser in self._browsers.values():
            browser.close()
        self._browsers.clear()
        if self._playwright is not None:
            self._playwright.stop()
            self._folder.cleanup()
            self._playwright = None


def without_priority(chromium: str, folder: Path) -> str:
    """Chromium that may not raise the priority of its drawing process, as it does wherever it can.

    As root it would: drawing in software on a slow machine it then starves its own page, and the dashboard.
    """
    if os.geteuid() != 0 or not shutil.which("setpriv"):
        return chromium
    program = folder / "chromium"
    program.write_text(f'#!/bin/sh\nexec setpriv --bounding-set=-sys_nice "{chromium}" "$@"\n')
    program.chmod(0o755)
    return str(program)


CHROMIUM = Chromium()
