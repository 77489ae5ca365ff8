"""The command itself: one line when ready, one line when it cannot, a quiet end."""

import re
import signal
import socket
import subprocess
import sys
import urllib.request

import pytest


@pytest.fixture
def taken_port():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        yield other.getsockname()[1]


def start(*arguments):
    return subprocess.Popen([sys.executable, "-m", "surefoot", "dashboard", *map(str, arguments)], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)  # fmt: skip


def test_it_says_when_it_is_ready_and_stops_quietly_on_ctrl_c():
    running = start("--port", 0)
    line = running.stdout.readline()
    address = re.search(r"http://127\.0\.0\.1:\d+", line)
    assert address, line
    with urllib.request.urlopen(address.group()) as page:
        assert page.status == 200
    running.send_signal(signal.SIGINT)
    out, errors = running.communicate(timeout=120)
    assert running.returncode == 0
    assert errors == ""
    assert "Traceback" not in out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--port", "taken"), "taken"),
        (("--port", "99999"), "no such port"),
        (("--host", "0.0.0.0"), "--token"),
        (("--scenario", "no_such"), "no_such"),
        (("--controller", "no_such"), "no such controller"),
    ],
)
def test_what_cannot_be_served_is_one_clear_line(arguments, said, taken_port):
    running = start(*(str(taken_port) if word == "taken" else word for word in arguments))
    out, errors = running.communicate(timeout=120)
    assert running.returncode == 2
    assert out == ""
    assert said in errors
    assert errors.count("\n") == 1
