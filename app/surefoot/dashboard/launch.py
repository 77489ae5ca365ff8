"""``surefoot dashboard``: session, page and server put together, until Ctrl-C."""

import contextlib
import io
import os
import signal
import socket
import sys
import threading
from dataclasses import dataclass

import viser

from surefoot.control.registry import controller_named
from surefoot.dashboard.access.gate import check_listening, guarded_server
from surefoot.dashboard.access.link_handoff import LinkHandoff
from surefoot.dashboard.engine.process_worker import ProcessWorker
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.engine.thread_priority import SHOWS, prefer
from surefoot.dashboard.engine.worker import InlineWorker, Request, RunSpec, Worker
from surefoot.dashboard.page import Page
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.scenario import load_scenario

FIRST_PORT = 8080
_PORTS_TRIED = 100
_SWITCH_INTERVAL_S = 0.0005  # how long a thread keeps Python before another may have it


@dataclass(frozen=True)
class Dashboard:
    """A running dashboard.

    Attributes:
        address: what to open in a browser.
        session, page, server: its parts.
    """

    address: str
    session: Session
    page: Page
    server: viser.ViserServer

    def stop(self) -> None:
        """Stop all threads."""
        self.page.stop()
        self.session.stop()
        self.server.stop()


def start_dashboard(
    *, host: str = "127.0.0.1", port: int | None = None, token: str | None = None, scenario: str = "stand_left",
    controller: str = "two-part", paced: bool = True, processes: bool = True,
) -> Dashboard:  # fmt: skip
    """Start everything and return.

    Args:
        host: see ``surefoot dashboard --help``, as for the next four.
        port: 0 for any.
        token: asked of strangers.
        scenario: to start with.
        controller: to start with.
        paced: follow the wall clock.
        processes: simulate in processes of their own, beside the page's.

    Raises:
        SurefootError: host, port, token, scenario or controller cannot be used.
    """
    check_listening(host, token)
    spec = RunSpec(load_scenario(scenario), controller_named(controller).name)
    chosen, links = free_port(host, port), LinkHandoff()
    spawn = _spawn if processes else InlineWorker
    first = spawn()  # its process starts while the server does
    sys.setswitchinterval(_SWITCH_INTERVAL_S)
    server: viser.ViserServer | None = None
    try:
        first.begin(Request(start=spec))
        with contextlib.redirect_stdout(io.StringIO()):  # viser's own banner
            before = set(threading.enumerate())
            server = guarded_server(host, chosen, token, links)
            prefer(SHOWS, (thread for thread in threading.enumerate() if thread not in before))
        if chosen and server.get_port() != chosen:  # viser moves on to the next port without a word
            raise InvalidInput("--port", chosen, "was taken by another program just now")
        first.finish()
        session = Session(first, spawn=spawn, paced=paced)
        page = Page(server, session, spec.scenario.robot_description())
        links.connect(server, session.send, page.driver_lock.holder)
    except BaseException:
        first.close()
        if server is not None:
            server.stop()
        raise
    session.start()
    page.start()
    shown = "localhost" if host in ("0.0.0.0", "::", "") else host
    query = f"/?token={token}" if token else ""
    return Dashboard(f"http://{f'[{shown}]' if ':' in shown else shown}:{server.get_port()}{query}", session, page,
                     server)  # fmt: skip


def serve(*, host: str, port: int | None, token: str | None, scenario: str, controller: str) -> None:
    """Serve the page until Ctrl-C; prints one line when it can be opened."""
    dashboard = start_dashboard(host=host, port=port, token=token, scenario=scenario, controller=controller)
    stop = threading.Event()
    for name in (signal.SIGINT, signal.SIGTERM):
        signal.signal(name, lambda *_: stop.set())
    print(f"Surefoot is ready: open {dashboard.address} (Ctrl-C stops it)", flush=True)
    while not stop.wait(0.5):
        pass
    print("stopping ...", flush=True)
    with contextlib.redirect_stdout(io.StringIO()):
        dashboard.stop()
    os._exit(0)  # viser's pool threads would be waited for otherwise


def _spawn() -> Worker:
    try:
        return ProcessWorker()
    except OSError as error:
        print(f"surefoot: no process of its own for the simulation, so the page may be slow: {error}", file=sys.stderr)
        return InlineWorker()


def free_port(host: str, port: int | None) -> int:
    """A given port, checked to be free, or the first free one from 8080. Raises InvalidInput."""
    if port is not None:
        if not 0 <= port <= 65535:
            raise InvalidInput("--port", port, "no such port", ["0 to 65535"])
        if not _is_free(host, port):
            raise InvalidInput("--port", port, f"cannot be listened on at {host}: taken or not allowed")
        return port
    for candidate in range(FIRST_PORT, FIRST_PORT + _PORTS_TRIED):
        if _is_free(host, candidate):
            return candidate
    raise InvalidInput("--host", host, f"no free port from {FIRST_PORT} to {FIRST_PORT + _PORTS_TRIED - 1}")


def _is_free(host: str, port: int) -> bool:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
    except OSError:
        return False
    return True
