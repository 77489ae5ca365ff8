"""A Chromium that draws in software, for the scripts beside this file."""

import os

PATH = os.environ.get("SUREFOOT_CHROMIUM", "/usr/bin/chromium")
ARGUMENTS = (
    "--no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --disable-quic --no-first-run "
    "--disable-background-networking --disable-component-update --disable-sync"
).split()
PATIENCE_MS = 120_000
TOUR_SEEN = "localStorage.setItem('viser-user:surefoot-tour', 'seen')"
