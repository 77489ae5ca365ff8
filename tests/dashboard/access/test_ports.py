"""The port of a page and the address to open it at."""

import socket

import pytest

from surefoot.dashboard.access.ports import free_port, page_address, printed_address
from surefoot.errors import InvalidInput


@pytest.mark.parametrize(
    ("host", "address"),
    [
        ("127.0.0.1", "http://127.0.0.1:8080"),
        ("0.0.0.0", "http://localhost:8080"),
        ("::", "http://localhost:8080"),
        ("::1", "http://[::1]:8080"),
        ("robot.lan", "http://robot.lan:8080"),
    ],
)
def test_the_address_is_one_that_a_browser_opens(host, address):
    assert page_address(host, 8080) == address
    assert page_address(host, 8080, "abcdefgh12345678") == f"{address}/?token=abcdefgh12345678"


@pytest.mark.parametrize("terminal", [True, False])
def test_the_token_is_printed_on_a_terminal_only(monkeypatch, terminal):
    monkeypatch.setattr("sys.stdout.isatty", lambda: terminal)
    address = page_address("robot.lan", 8080, "abcdefgh12345678")
    assert ("abcdefgh12345678" in printed_address(address)) is terminal
    assert printed_address(address).startswith("http://robot.lan:8080")


def test_a_taken_port_is_refused():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        with pytest.raises(InvalidInput, match="taken"):
            free_port("127.0.0.1", other.getsockname()[1])
