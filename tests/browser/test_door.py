"""What a browser meets at the door: the page's own policy, and a proxy that nobody has told the dashboard about."""

import re
import socket
import threading

import pytest

pytestmark = pytest.mark.browser


class RewritingProxy:
    """Hands connections on under another Host, as nginx does unless told otherwise.

    Args:
        port: of the server behind, on this machine.
    """

    def __init__(self, port):
        self._host = f"127.0.0.1:{port}".encode()
        self._behind = ("127.0.0.1", port)
        self._door = socket.create_server(("127.0.0.1", 0))
        self.address = f"http://127.0.0.1:{self._door.getsockname()[1]}"
        threading.Thread(target=self._serve, daemon=True).start()

    def stop(self):
        self._door.close()

    def _serve(self):
        while True:
            try:
                visitor = self._door.accept()[0]
            except OSError:
                return
            threading.Thread(target=self._hand_on, args=(visitor,), daemon=True).start()

    def _hand_on(self, visitor):
        with visitor, socket.create_connection(self._behind) as server:
            request = b""
            while b"\r\n\r\n" not in request and (more := visitor.recv(65536)):
                request += more
            server.sendall(re.sub(rb"(?i)\r\nhost: [^\r]*", b"\r\nHost: " + self._host, request, count=1))
            while more := server.recv(65536):
                visitor.sendall(more)


def test_the_page_draws_under_its_policy_and_a_proxy_unheard_of_is_named(screen):
    complaints = []
    screen.page.on("console", lambda message: complaints.append(message.text) if message.type == "error" else None)
    screen.page.on("pageerror", lambda error: complaints.append(str(error)))
    screen.page.reload()
    screen.settle()
    screen.wait_for(lambda: screen.pixels().std() > 5.0)
    assert complaints == []

    proxy = RewritingProxy(screen.dashboard.server.get_port())
    screen.page.goto(proxy.address)
    reason = screen.page.get_by_role("alert", name="Why this page cannot connect")
    reason.wait_for()
    assert f"--allow-origin {proxy.address}" in reason.inner_text()
    screen.keep("refused")
    proxy.stop()
