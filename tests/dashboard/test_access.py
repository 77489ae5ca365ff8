"""Who gets in: our own page, nobody else's."""

import socket
import urllib.error
import urllib.request

import pytest
import viser
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from app.dashboard.access import Gate, check_listening
from app.dashboard.serve import free_port, start_dashboard
from app.errors import InvalidInput

TOKEN = "abcdefgh12345678"


def knock(port, origin, *, host="127.0.0.1", cookie=None, query=""):
    """Status of a websocket handshake: 101 when let in."""
    headers = {"Cookie": cookie} if cookie else {}
    try:
        with connect(f"ws://{host}:{port}/{query}", origin=origin, additional_headers=headers,
                     subprotocols=[f"viser-v{viser.__version__}"]):  # fmt: skip
            return 101
    except InvalidStatus as refused:
        return refused.response.status_code


@pytest.mark.parametrize("name", ["127.0.0.1", "localhost"])
def test_our_own_page_is_let_in(dashboard, name):
    port = dashboard.server.get_port()
    assert knock(port, f"http://{name}:{port}") == 101


def test_a_program_without_origin_is_let_in(dashboard):
    assert knock(dashboard.server.get_port(), None) == 101


@pytest.mark.parametrize("origin", ["http://evil.example", "http://localhost:1", "https://127.0.0.1.evil.example",
                                    "null", "file://"])  # fmt: skip
def test_a_foreign_page_gets_403(dashboard, origin):
    assert knock(dashboard.server.get_port(), origin) == 403


def test_a_foreign_name_for_this_machine_gets_403(dashboard):
    request = urllib.request.Request(dashboard.address, headers={"Host": "evil.example"})
    with pytest.raises(urllib.error.HTTPError) as refused:
        urllib.request.urlopen(request)
    assert refused.value.code == 403


def test_it_listens_on_this_machine_only(dashboard):
    assert dashboard.server.get_host() == "127.0.0.1"
    assert dashboard.server.request_share_url() is None


def test_a_token_is_asked_for_and_kept_in_a_cookie():
    running = start_dashboard(port=0, token=TOKEN)
    try:
        port = running.server.get_port()
        origin = f"http://127.0.0.1:{port}"
        assert knock(port, origin) == 403
        assert knock(port, origin, cookie="surefoot_token=wrong") == 403
        assert knock(port, origin, cookie=f"surefoot_token={TOKEN}") == 101
        with urllib.request.urlopen(running.address) as page:
            assert page.headers["Set-Cookie"].startswith(f"surefoot_token={TOKEN}; HttpOnly; SameSite=Strict")
    finally:
        running.stop()


def test_elsewhere_only_the_same_place_may_talk():
    gate = Gate(TOKEN)
    assert gate.refusal("robot.lan:8080", "http://robot.lan:8080", f"/?token={TOKEN}", "") is None
    assert gate.refusal("robot.lan:8080", "http://evil.example", f"/?token={TOKEN}", "") is not None
    assert gate.refusal("robot.lan:8080", "http://localhost:8080", f"/?token={TOKEN}", "") is not None


@pytest.mark.parametrize(("host", "token"), [("0.0.0.0", None), ("192.168.1.2", None), ("127.0.0.1", "short"),
                                             ("0.0.0.0", "1234567890 12345; x")])  # fmt: skip
def test_listening_elsewhere_needs_a_good_token(host, token):
    with pytest.raises(InvalidInput):
        check_listening(host, token)


def test_a_taken_port_is_refused():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        with pytest.raises(InvalidInput, match="taken"):
            free_port("127.0.0.1", other.getsockname()[1])


def test_a_bad_scenario_or_controller_starts_nothing():
    with pytest.raises(InvalidInput, match="no_such"):
        start_dashboard(port=0, scenario="no_such_scenario")
    with pytest.raises(InvalidInput, match="no_such"):
        start_dashboard(port=0, controller="no_such_controller")
