"""Waiting for a condition; the deadline only keeps a broken program from hanging."""

import time

PATIENCE_S = 300.0


def wait_for(condition, every_s=0.01):
    """Return when a condition is true; AssertionError when it never comes true."""
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(every_s)
