"""What the server answers: why somebody is refused, how the page is served, what never reaches the terminal."""

import asyncio
import gc
import logging
import re
import socket
import struct

import msgspec
import pytest
import viser
from viser import _messages
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from surefoot.dashboard.access.guarded_server import LARGEST_MESSAGE
from surefoot.dashboard.access.served_page import QUESTION, question_url
from surefoot.dashboard.access.uploads import LARGEST_UPLOAD
from surefoot.dashboard.launch import start_dashboard
from tests.support.requests import ask
from tests.support.waiting import wait_for

PROXY, TOKEN = "https://robot.example.org", "abcdefgh12345678"
KEY = {"Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ=="}
VISER = [f"viser-v{viser.__version__}"]


@pytest.fixture(scope="module")
def proxied():
    """A dashboard that a proxy stands before."""
    running = start_dashboard(port=0, processes=False, allow_origin=[PROXY])
    yield running
    running.stop()


def handshake(running, **headers):
    """Status of a websocket's handshake: 101 when let in."""
    of_websocket = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13"}
    return ask(running, **of_websocket, **KEY, **headers, **{"Sec-WebSocket-Protocol": VISER[0]})[0]


def address(running):
    return f"ws://127.0.0.1:{running.server.get_port()}/"


def test_a_foreign_host_is_told_what_was_refused_and_the_flag_that_allows_it(dashboard):
    status, headers, text = ask(dashboard, Host="robot.example.org", X_Forwarded_Proto="https")
    assert status == 403
    assert headers["Content-Type"].startswith("text/html")
    assert "robot.example.org" in text
    assert f"surefoot dashboard --allow-origin {PROXY}" in text
    status, _, text = ask(dashboard, Host='"><script>alert(1)</script>')
    assert status == 403
    assert "<script" not in text


@pytest.mark.parametrize(
    ("origin", "says"),
    [
        ("https://robot.example.org", r"--allow-origin https://robot\.example\.org$"),
        ("http://robot.example.org:9000", r"--allow-origin http://robot\.example\.org:9000$"),
        ("null", "own address"),
        ("http://127.0.0.1:{port}", "^$"),
    ],
)
def test_a_page_whose_websocket_would_be_refused_learns_why(dashboard, origin, says):
    """A proxy that rewrites Host: the page itself arrives, but from where, only its script knows."""
    asked = origin.format(port=dashboard.server.get_port())
    assert handshake(dashboard, Origin=asked) == (403 if says != "^$" else 101)
    status, headers, text = ask(dashboard, question_url(asked))
    assert (status, headers["Content-Type"]) == (200, "text/plain; charset=utf-8")
    assert re.search(says, text), text


def test_the_page_that_is_served_asks(dashboard):
    for encoding in ("gzip", "identity"):
        status, headers, _ = ask(dashboard, Accept_Encoding=encoding)
        assert (status, headers["Content-Encoding"]) == (200, encoding)
    text = ask(dashboard, "/?scenario=push_left")[2]
    assert text.count("why-refused?origin=") == 1
    assert text.index("why-refused") < text.index("DecompressionStream")  # before viser's own


@pytest.mark.parametrize("host", ["robot.example.org", "127.0.0.1", "localhost:9"])
def test_an_allowed_proxy_may_rewrite_host_or_not(proxied, host):
    assert ask(proxied, Host=host)[0] == 200
    assert ask(proxied, question_url(PROXY), Host=host)[2] == ""
    assert handshake(proxied, Host=host, Origin=PROXY) == 101


@pytest.mark.parametrize(
    "origin", ["http://robot.example.org", "https://robot.example.org:8443", "https://x.robot.example.org", "null"]
)
def test_only_the_very_origin_is_allowed(proxied, origin):
    assert handshake(proxied, Origin=origin) == 403


def test_a_foreign_host_stays_refused_behind_a_proxy(proxied):
    assert ask(proxied, Host="evil.example")[0] == 403
    assert handshake(proxied, Host="evil.example", Origin=PROXY) == 403


def test_a_proxy_that_hands_no_websockets_on_is_named(proxied):
    assert ask(proxied, Origin=PROXY, **KEY)[0] == 426
    assert "Upgrade and Connection" in ask(proxied, question_url(PROXY))[2]
    assert handshake(proxied, Origin=PROXY) == 101
    assert ask(proxied, question_url(PROXY))[2] == ""


def test_the_page_may_open_websockets_to_its_own_places_only(proxied):
    port = proxied.server.get_port()
    policy = ask(proxied)[1]["Content-Security-Policy"]
    (sockets,) = re.findall(r"connect-src 'self' data: blob:([^;]*)", policy)
    assert sockets.split() == [
        f"ws://127.0.0.1:{port}",
        f"wss://127.0.0.1:{port}",
        "ws://robot.example.org",
        "wss://robot.example.org",
    ]
    assert "evil" not in ask(proxied, Host="localhost; script-src evil")[1]["Content-Security-Policy"]


def test_every_answer_keeps_the_page_to_itself(dashboard):
    for path, headers in (("/", {}), ("/no/such", {}), (question_url("null"), {}), ("/", {"Host": "evil.example"})):
        found = ask(dashboard, path, **headers)[1]
        assert found["Referrer-Policy"] == "no-referrer"
        assert found["X-Content-Type-Options"] == "nosniff"
        assert found["X-Frame-Options"] == "SAMEORIGIN"
        (policy,) = found.get_all("Content-Security-Policy")
        assert policy.startswith("default-src 'none'; ")
        assert re.search("frame-ancestors '(self|none)'", policy)
        assert "http" not in policy and "*" not in policy  # nothing from elsewhere


NONSENSE = {
    "nothing": b"",
    "half a request": b"GET / HTTP/1.1\r\nHost: loc",
    "a TLS hello": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(200),
    "an over-long line": b"GET /" + b"a" * 20_000 + b" HTTP/1.1\r\n\r\n",
    "a name too long for a file": b"GET /" + b"a" * 400 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
    "another method": b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\n\r\nx",
    "too many headers": b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 500 + b"\r\n",
    "two hosts": b"GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n",
    "a websocket of no kind": b"GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n\r\n",
    "a websocket of old": b"GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    b"Sec-WebSocket-Protocol: viser-v0\r\nSec-WebSocket-Version: 7\r\nSec-WebSocket-Key: x\r\n\r\n",
}


@pytest.fixture
def terminal(dashboard, capfd, caplog):
    """Asks what the terminal, and whoever looks at warnings, has seen; waits until all connections are gone."""
    caplog.set_level(logging.DEBUG)
    before = set(live_tasks(dashboard))

    def seen():
        wait_for(lambda: set(live_tasks(dashboard)) <= before)
        gc.collect()  # a task's exception is reported when it goes
        out, errors = capfd.readouterr()
        loud = [record for record in caplog.records if record.levelno >= logging.INFO]
        return out + errors + "".join(record.getMessage() for record in loud)

    return seen


def live_tasks(dashboard):
    """The connections' tasks."""
    loop = dashboard.server.get_event_loop()

    async def count():
        return [task for task in asyncio.all_tasks() if "conn_handler" in repr(task.get_coro())]

    return asyncio.run_coroutine_threadsafe(count(), loop).result(timeout=60)


@pytest.mark.parametrize("sent", NONSENSE.values(), ids=NONSENSE)
def test_a_peer_that_is_no_browser_leaves_no_trace(dashboard, terminal, sent):
    for reset in (0, 1):  # it closes the connection, or breaks it
        with socket.create_connection(("127.0.0.1", dashboard.server.get_port())) as peer:
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", reset, 0))
            peer.sendall(sent)
    assert terminal() == ""


MESSAGES = [
    "a text",
    b"",
    b"\xc1",
    msgspec.msgpack.encode([1]),
    msgspec.msgpack.encode({"type": "no such"}),
    msgspec.msgpack.encode({"type": "GuiUpdateMessage"}),
    msgspec.msgpack.encode({"type": "GuiUpdateMessage", "uuid": [1], "updates": {}}),
    msgspec.msgpack.encode({"type": "ViewerCameraMessage", "uuid": "x"}),
]


@pytest.mark.parametrize("message", MESSAGES, ids=repr)
def test_a_nonsensical_message_leaves_no_trace(dashboard, terminal, message):
    with connect(address(dashboard), subprotocols=VISER, max_size=None) as peer:
        peer.send(message)
    assert terminal() == ""


def test_an_error_of_our_own_is_still_told(terminal):
    logging.getLogger("surefoot.dashboard.websockets").error("connection handler failed", exc_info=ArithmeticError())
    assert "connection handler failed" in terminal()


def test_no_log_has_a_token(dashboard, terminal, caplog):
    ask(dashboard, f"/?token={TOKEN}", Cookie=f"surefoot_token={TOKEN}")
    terminal()
    assert TOKEN not in caplog.text


def test_a_message_larger_than_any_of_a_page_ends_the_connection(dashboard):
    with connect(address(dashboard), subprotocols=VISER, max_size=None) as peer:
        with pytest.raises(ConnectionClosed):
            peer.send(bytes(LARGEST_MESSAGE + 1))
            while True:
                peer.recv(timeout=60)
        assert peer.close_code == 1009


def test_an_upload_is_cut_at_its_limit(dashboard):
    server, client_id = dashboard.server, 77
    waiting = server.gui._current_file_upload_states
    handles = server.gui._gui_input_handle_from_uuid.items()
    button = next(uuid for uuid, handle in handles if getattr(handle, "label", "") == "Load settings")

    def send(message):
        arrived = server._websock_server._handle_incoming_message(client_id, message)
        asyncio.run_coroutine_threadsafe(arrived, server.get_event_loop()).result(timeout=60)

    def start(name, size):
        send(_messages.FileTransferStartUpload(button, name, f"{name}.toml", "", part_count=2, size_bytes=size))

    start("large", LARGEST_UPLOAD + 1)
    start("first", LARGEST_UPLOAD - 10)
    start("one more", 11)
    assert list(waiting) == ["first"]
    waiting.clear()
    start("liar", 4)
    send(_messages.FileTransferPart(button, "liar", 0, b"1234"))
    assert list(waiting) == ["liar"]
    send(_messages.FileTransferPart(button, "liar", 1, b"5"))
    assert not waiting


@pytest.mark.parametrize("encoding", ["identity", "gzip"])
def test_the_page_has_the_scripts_before_its_body(dashboard, encoding):
    _, headers, text = ask(dashboard, Accept_Encoding=encoding)
    assert headers["Content-Encoding"] == encoding
    head, _, _ = text.partition("<body>")
    assert head.count("mantine-NumberInput-input") == 1
    assert head.count(QUESTION.lstrip("/")) == 1
