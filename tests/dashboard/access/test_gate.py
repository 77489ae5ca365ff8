"""Who gets in: our own page, nobody else's."""

import urllib.error
import urllib.request

import pytest
import viser
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from surefoot.dashboard.access.gate import Gate, check_listening
from surefoot.dashboard.access.served_page import question_url
from surefoot.dashboard.launch import start_dashboard
from surefoot.errors import InvalidInput
from tests.support.requests import ask

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


@pytest.fixture(scope="module")
def locked():
    """A dashboard with a token."""
    running = start_dashboard(port=0, token=TOKEN, processes=False)
    yield running
    running.stop()


def test_a_websocket_needs_the_token(locked):
    port = locked.server.get_port()
    origin = f"http://127.0.0.1:{port}"
    assert knock(port, origin) == 403
    assert knock(port, origin, cookie="surefoot_token=wrong") == 403
    assert knock(port, origin, cookie=f"surefoot_token={TOKEN}") == 101


def test_the_page_asks_for_the_token_and_nothing_else_is_served(locked):
    status, headers, text = ask(locked, "/?scenario=push_left&x=%22%3E%3Cscript%3E")
    assert status == 403
    assert '<input id="token" name="token" type="password"' in text
    assert 'name="scenario" value="push_left"' in text
    assert "<script>" not in text
    assert "http" not in text.replace("http-equiv", "")  # nothing from elsewhere
    assert headers["Cache-Control"] == "no-store"
    status, _, text = ask(locked, "/hdri/none.hdr")
    assert (status, "<form" in text) == (403, False)


@pytest.mark.parametrize("wrong", ["nope", "", "%FF", TOKEN + "x", TOKEN.upper()])
def test_a_wrong_token_gets_the_form_again(locked, wrong):
    status, headers, text = ask(locked, f"/?token={wrong}")
    assert status == 403
    assert 'role="alert"' in text
    assert "Set-Cookie" not in headers


def test_the_right_token_becomes_a_cookie_and_leaves_the_address(locked):
    path = f"/?a=%20b&token={TOKEN}&scenario=push_left"
    status, headers, _ = ask(locked, path, Sec_Fetch_Site="same-origin")
    assert (status, headers["Location"]) == (303, "/?a=%20b&scenario=push_left")
    assert headers["Set-Cookie"] == f"surefoot_token={TOKEN}; HttpOnly; SameSite=Strict; Path=/"
    status, headers, text = ask(locked, path)  # a browser that does not say where it comes from
    assert (status, headers["Set-Cookie"][:14]) == (200, "surefoot_token")
    assert 'content="0;url=/?a=%20b&amp;scenario=push_left"' in text
    assert TOKEN not in text


def test_with_the_cookie_the_page_is_served_and_a_link_gets_its_ticket(locked):
    cookie = f"surefoot_token={TOKEN}"
    status, headers, text = ask(locked, "/?scenario=push_left", Cookie=cookie, Sec_Fetch_Dest="document")
    assert status == 200
    assert "<form" not in text
    assert headers["Set-Cookie"].startswith("surefoot_link=")


def test_a_page_without_the_token_of_a_new_start_learns_that(locked):
    question = question_url(f"http://127.0.0.1:{locked.server.get_port()}")
    assert "token" in ask(locked, question, Cookie="surefoot_token=of-the-start-before")[2]
    assert ask(locked, question, Cookie=f"surefoot_token={TOKEN}")[2] == ""


def test_a_link_from_elsewhere_is_asked_again_from_here_where_the_cookie_comes_along(locked):
    status, _, text = ask(locked, "/?scenario=push_left", Sec_Fetch_Site="cross-site")
    assert status == 200
    assert 'content="0;url=/?scenario=push_left"' in text
    assert "<form" in ask(locked, "/", Sec_Fetch_Site="same-origin")[2]
    assert ask(locked, "//evil.example/", Sec_Fetch_Site="cross-site")[0] == 403


def test_the_token_is_compared_in_constant_time(monkeypatch):
    compared = []
    monkeypatch.setattr("hmac.compare_digest", lambda given, token: compared.append((given, token)) or False)
    assert not Gate(TOKEN).knows(f"/?token={TOKEN}", f"surefoot_token={TOKEN}")  # whatever that says, counts
    assert compared == [(TOKEN.encode(), TOKEN.encode())] * 2


def test_elsewhere_only_the_same_place_may_talk():
    gate = Gate(TOKEN)
    assert gate.foreign("robot.lan:8080", "http://robot.lan:8080") is None
    assert gate.foreign("robot.lan", "https://robot.lan") is None  # a proxy that speaks TLS and hands the name on
    for foreign in ("http://evil.example", "http://localhost:8080", "http://robot.lan", "null"):
        assert gate.foreign("robot.lan:8080", foreign) is not None


@pytest.mark.parametrize(("host", "token"), [("0.0.0.0", None), ("192.168.1.2", None), ("127.0.0.1", "short"),
                                             ("0.0.0.0", "1234567890 12345; x")])  # fmt: skip
def test_listening_elsewhere_needs_a_good_token(host, token):
    with pytest.raises(InvalidInput):
        check_listening(host, token)


def test_a_bad_scenario_or_controller_starts_nothing():
    with pytest.raises(InvalidInput, match="no_such"):
        start_dashboard(port=0, scenario="no_such_scenario")
    with pytest.raises(InvalidInput, match="no_such"):
        start_dashboard(port=0, controller="no_such_controller")
