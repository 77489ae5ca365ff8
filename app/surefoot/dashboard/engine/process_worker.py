"""A worker in a process of its own: Python runs one thread at a time, two robots and a page need more than that.

The process is this module, started as a program. ``multiprocessing`` is not used for that: its spawn imports the main
program of whoever starts it once more (``pytest``, a notebook, a script without a guard). It ends with its parent, as
the connection is closed then, and hears no Ctrl-C.
"""

import os
import socket
import subprocess
import sys
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from surefoot.blas_threads import ONE_THREAD
from surefoot.dashboard.engine.threads import prefer_session
from surefoot.dashboard.engine.wire_format import Packer, Unpacker
from surefoot.dashboard.engine.worker import Reply, Request, RequestRunner, WorkerLostError
from surefoot.errors import SurefootError

_GRACE_S = 5.0
_READY = "ready"
# Where its modules come from: from where ours do. -P: never from the working folder.
_ISOLATION = ("-I",) if sys.flags.isolated else ("-P",)


class ProcessWorker:
    """Plays in a process of its own, started at once and kept.

    Raises:
        OSError: no process can be started.
    """

    def __init__(self) -> None:
        ours, theirs = socket.socketpair()
        root = str(Path(__file__).resolve().parents[3])
        folders = [folder or os.getcwd() for folder in sys.path]
        path = os.pathsep.join(folders if root in folders else [root, *folders])
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, *_ISOLATION, "-m", "surefoot.dashboard.engine.process_worker", str(theirs.fileno())],
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                env={**os.environ, **ONE_THREAD, "PYTHONPATH": path},
                start_new_session=True,
            )
        self._connection = Connection(ours.detach())
        self._ready = False
        self._unpacker = Unpacker()

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    def ready(self) -> bool:
        """Whether it has started. Raises WorkerLostError."""
        try:
            if not self._ready and self._connection.poll():
                self._ready = self._connection.recv() == _READY
        except (EOFError, OSError):
            raise self._lost() from None
        return self._ready

    def begin(self, request: Request) -> None:
        """Ask for a request. Raises WorkerLostError."""
        try:
            self._connection.send(request)
        except OSError:
            raise self._lost() from None

    def finish(self) -> Reply:
        """Wait for what came of it. Raises WorkerLostError; SurefootError when ``start`` cannot be done."""
        try:
            answer = self._connection.recv()
            if answer == _READY:
                self._ready, answer = True, self._connection.recv()
        except (EOFError, OSError):
            raise self._lost() from None
        if isinstance(answer, str):
            raise SurefootError(answer)
        return self._unpacker.unpack(answer)

    def close(self) -> None:
        """End the process and wait for it."""
        self._connection.close()
        try:
            self._process.wait(_GRACE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _lost(self) -> WorkerLostError:
        try:
            code = self._process.wait(_GRACE_S)
        except subprocess.TimeoutExpired:
            code = None
        why = "no answer" if code is None else f"signal {-code}" if code < 0 else f"exit code {code}"
        return WorkerLostError(f"the process that simulates has ended ({why})")


def serve_requests(connection: Connection) -> None:
    """Carry out requests until the other end is closed."""
    prefer_session()
    runner, packer = RequestRunner(), Packer()
    try:
        connection.send(_READY)
        while True:
            request = connection.recv()
            try:
                answer: Any = packer.pack(runner.run(request))
            except SurefootError as error:  # the run cannot be begun
                answer = str(error)
            connection.send(answer)
    except (EOFError, BrokenPipeError, ConnectionResetError):
        return


if __name__ == "__main__":
    serve_requests(Connection(int(sys.argv[1])))
