"""``surefoot dashboard``: session, page and server put together, until Ctrl-C."""

import contextlib
import io
import os
import signal
import sys
import threading
from collections.abc import Iterable
from dataclasses import dataclass

import viser

from surefoot.control.registry import controller_named
from surefoot.dashboard.access.gate import Gate, check_listening
from surefoot.dashboard.access.guarded_server import guarded_server
from surefoot.dashboard.access.link_handoff import LinkHandoff
from surefoot.dashboard.access.origins import allowed_origins
from surefoot.dashboard.access.paced_messages import PacedMessages
from surefoot.dashboard.access.ports import free_port, page_address, printed_address
from surefoot.dashboard.engine.process_worker import ProcessWorker
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.engine.threads import SHOWS, prefer
from surefoot.dashboard.engine.worker import InlineWorker, Request, RunSpec, Worker
from surefoot.dashboard.page import Page
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.scenario import load_scenario

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
    *,
    host: str = "127.0.0.1",
    port: int | None = None,
    token: str | None = None,
    allow_origin: Iterable[str] = (),
    scenario: str = "stand_left",
    controller: str = "two-part",
    robot: str | None = None,
    paced: bool = True,
    processes: bool = True,
) -> Dashboard:
    """Start everything and return.

    Args:
        host: see ``surefoot dashboard --help``, as for the next five.
        port: 0 for any.
        token: asked of strangers.
        allow_origin: origins of proxies before this page.
        scenario: to start with.
        controller: to start with.
        robot: to start with, a name or the path of a file; None: the scenario's.
        paced: follow the wall clock.
        processes: simulate in processes of their own, beside the page's.

    Raises:
        SurefootError: host, port, token, origin, scenario, controller or robot cannot be used.
    """
    check_listening(host, token)
    gate = Gate(token, allowed_origins(allow_origin))
    changes = {"robot": robot} if robot is not None else {}
    spec = RunSpec(load_scenario(scenario, changes, robot_files=True), controller_named(controller).name)
    chosen, links, paces = free_port(host, port), LinkHandoff(), PacedMessages()
    spawn = _spawn if processes else InlineWorker
    first = spawn()  # its process starts while the server does
    sys.setswitchinterval(_SWITCH_INTERVAL_S)
    server: viser.ViserServer | None = None
    try:
        first.begin(Request(start=spec))
        with contextlib.redirect_stdout(io.StringIO()):  # viser's own banner
            before = set(threading.enumerate())
            server = guarded_server(host, chosen, gate, links, paces)
            prefer(SHOWS, (thread for thread in threading.enumerate() if thread not in before))
        if chosen and server.get_port() != chosen:  # viser moves on to the next port without a word
            raise InvalidInput("--port", chosen, "was taken by another program just now")
        robot_shown = spec.scenario.robot_description()
        first.finish()
        session = Session(first, spawn=spawn, paced=paced)
        page = Page(server, session, robot_shown, paces)
        links.connect(server, session.send, page.driver_lock.holder, lambda: session.snapshot)
    except BaseException:
        first.close()
        if server is not None:
            server.stop()
        raise
    session.start()
    page.start()
    return Dashboard(page_address(host, server.get_port(), token), session, page, server)


def serve(
    *,
    host: str,
    port: int | None,
    token: str | None,
    allow_origin: Iterable[str],
    scenario: str,
    controller: str,
    robot: str | None,
) -> None:
    """Serve the page until Ctrl-C; prints one line when it can be opened."""
    dashboard = start_dashboard(
        host=host,
        port=port,
        token=token,
        allow_origin=allow_origin,
        scenario=scenario,
        controller=controller,
        robot=robot,
    )
    stop = threading.Event()
    for name in (signal.SIGINT, signal.SIGTERM):
        signal.signal(name, lambda *_: stop.set())
    print(f"Surefoot is ready: open {printed_address(dashboard.address)} (Ctrl-C stops it)", flush=True)
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
