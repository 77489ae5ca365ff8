"""Who may talk to the page: no foreign host or origin, no stranger without the token."""

import hmac
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie

from surefoot.dashboard.access.login_page import token_in
from surefoot.dashboard.access.origins import LOOPBACK, Origin, host_name, is_same_place, read_origin
from surefoot.errors import InvalidInput

LEAST_TOKEN = 16
_COOKIE = "surefoot_token"


def check_listening(host: str, token: str | None) -> None:
    """Listening on other addresses than this machine's own needs a token. Raises InvalidInput."""
    if token is not None and (len(token) < LEAST_TOKEN or not token.isascii() or not token.isalnum()):
        raise InvalidInput("--token", "...", "must be letters and digits", [f"{LEAST_TOKEN} or more of them"])
    if host not in LOOPBACK and token is None:
        raise InvalidInput("--host", host, "anyone there could drive the robot: give a --token too", LOOPBACK)


@dataclass(frozen=True)
class Refusal:
    """Why somebody is not let in, and what would change that.

    Attributes:
        what: what was refused and why, a sentence.
        remedy: what to do when that was meant to work, a sentence; ends with the flag if there is one.
        flag: to start the dashboard with; empty where none helps.
    """

    what: str
    remedy: str
    flag: str = ""

    def __str__(self) -> str:
        """All of it in one line."""
        return f"{self.what} {self.remedy}{f' {self.flag}' if self.flag else ''}"


class Gate:
    """Decides about every request before viser sees it.

    Args:
        token: what strangers must bring; None when only this machine may connect.
        allowed: origins of proxies before this page.
    """

    def __init__(self, token: str | None, allowed: frozenset[Origin] = frozenset()) -> None:
        self._token, self._allowed = token, allowed
        self._allowed_names = {origin.host for origin in allowed}

    @property
    def needs_token(self) -> bool:
        """Whether a token is asked for."""
        return self._token is not None

    @property
    def behind_proxy(self) -> bool:
        """Whether a proxy's origin is allowed."""
        return bool(self._allowed)

    @property
    def allowed_hosts(self) -> list[str]:
        """Name and port of every proxy allowed, as in its address."""
        return sorted(str(origin).partition("://")[2] for origin in self._allowed)

    def foreign(self, host: str, origin: str | None, scheme: str = "") -> Refusal | None:
        """Why a request from that place is refused whatever it brings, or None.

        Args:
            host: its Host header.
            origin: its Origin header; browsers always send one with a websocket, other programs none.
            scheme: what a proxy says that it was asked by, if any.
        """
        name = host_name(host)
        if self._token is None and name not in LOOPBACK and name not in self._allowed_names:
            return _foreign_host(host, scheme)  # a name of elsewhere that leads here would make its pages ours
        if origin is None:
            return None
        source = read_origin(origin)
        if source is not None and (source in self._allowed or is_same_place(source, host)):
            return None
        return _foreign_origin(origin, source, host)

    def knows(self, path: str, cookies: str) -> bool:
        """Whether a request brings the token, in its address or as the cookie; true where none is needed."""
        return self._token is None or self._is_token(token_in(path)) or self._is_token(_cookie_in(cookies))

    def guesses(self, path: str, cookies: str) -> bool:
        """Whether a request brings a token, but a wrong one."""
        return not self.knows(path, cookies) and (token_in(path) or _cookie_in(cookies)) is not None

    def new_cookie(self, path: str) -> str | None:
        """The cookie for a browser that came with the token in its address."""
        if not self._is_token(token_in(path)):
            return None
        return f"{_COOKIE}={self._token}; HttpOnly; SameSite=Strict; Path=/"

    def _is_token(self, given: str | None) -> bool:
        if self._token is None or given is None:
            return False
        return hmac.compare_digest(given.encode(errors="replace"), self._token.encode())


def _foreign_host(host: str, scheme: str) -> Refusal:
    guess = read_origin(f"{scheme if scheme in ('http', 'https') else 'https'}://{host}")
    shown = f"the name {host}" if host else "a request without a name"
    return Refusal(
        f"This dashboard answers to this machine's own names only, and was asked for under {shown}.",
        "If that is your proxy, start the dashboard with the address that the browser shows:",
        f"--allow-origin {guess or 'https://robot.example.org'}",
    )


def _foreign_origin(origin: str, source: Origin | None, host: str) -> Refusal:
    what = f"A page of {origin} may not drive this robot, whose server was asked for as {host}."
    if source is None:
        return Refusal(what, "Open the dashboard's own address in the browser.")
    return Refusal(what, "If that is your proxy, start the dashboard with its address:", f"--allow-origin {source}")


def _cookie_in(cookies: str) -> str | None:
    try:
        morsel = SimpleCookie(cookies).get(_COOKIE)
    except CookieError:
        return None
    return None if morsel is None else morsel.value
