"""Which addresses count as one place, and what --allow-origin takes."""

import pytest

from surefoot.dashboard.access.origins import allowed_origins, host_name, is_same_place, read_origin
from surefoot.errors import InvalidInput


@pytest.mark.parametrize(
    ("text", "as_sent"),
    [
        ("https://robot.example.org", "https://robot.example.org"),
        (" https://Robot.example.org/ ", "https://robot.example.org"),
        ("https://robot.example.org:443", "https://robot.example.org"),
        ("http://192.168.1.5:9000", "http://192.168.1.5:9000"),
        ("http://[2001:DB8::1]:80", "http://[2001:db8::1]"),
        ("https://bücher.example", "https://xn--bcher-kva.example"),
    ],
)
def test_an_allowed_origin_is_what_a_browser_sends(text, as_sent):
    (origin,) = allowed_origins([text])
    assert str(origin) == as_sent
    assert origin == read_origin(as_sent)


@pytest.mark.parametrize(
    "text",
    [
        "robot.example.org",
        "https://",
        "https://*.example.org",
        "*",
        "null",
        "ftp://robot.example.org",
        "https://robot.example.org/path",
        "https://robot.example.org?x=1",
        "https://me@robot.example.org",
        "https://robot.example.org:port",
        "https://robot.example.org:99999",
        "https://robot example.org",
        "https://[::1",
        "https://ü..example",
        "",
    ],
)
def test_what_is_no_origin_is_refused_in_one_line_with_examples(text):
    with pytest.raises(InvalidInput, match=r"--allow-origin.*valid: https://robot\.example\.org") as refused:
        allowed_origins([text])
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("origin", "host", "same"),
    [
        ("http://127.0.0.1:8080", "127.0.0.1:8080", True),
        ("http://localhost:8080", "127.0.0.1:8080", True),
        ("http://[::1]:8080", "localhost:8080", True),
        ("https://robot.lan", "robot.lan", True),
        ("https://robot.lan", "robot.lan:443", True),
        ("http://robot.lan", "robot.lan:443", False),
        ("http://localhost:1", "localhost:8080", False),
        ("http://localhost:8080", "robot.lan:8080", False),
        ("http://robot.lan:8080", "robot.lan:bad", False),
    ],
)
def test_a_page_and_its_server_are_one_place(origin, host, same):
    assert is_same_place(read_origin(origin), host) is same


@pytest.mark.parametrize("host", ["", "[::1", "[", "evil]:80"])
def test_a_host_that_is_none_has_no_name_of_ours(host):
    assert host_name(host) not in ("127.0.0.1", "localhost", "::1")
