"""A Chromium that draws in software, for the scripts beside this file."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

PATH = os.environ.get("SUREFOOT_CHROMIUM", "/usr/bin/chromium")
ARGUMENTS = (
    "--no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --disable-quic --no-first-run "
    "--disable-background-networking --disable-component-update --disable-sync"
).split()
PATIENCE_MS = 120_000
TOUR_SEEN = "localStorage.setItem('viser-user:surefoot-tour', 'seen')"


@contextmanager
def opened_page(address: str) -> Iterator[Any]:
    """A dashboard's page in a browser of its own, ready to be used; the tour has been seen."""
    import playwright.sync_api as api

    with api.sync_playwright() as running:
        browser = running.chromium.launch(executable_path=PATH, args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(PATIENCE_MS)
        page.add_init_script(TOUR_SEEN)
        page.goto(address)
        page.get_by_label("Controller", exact=True).wait_for()
        yield page
        browser.close()
