"""One robot of the page: the worker that simulates it, what it is to run, and what it said last."""

from collections.abc import Callable
from enum import Enum

from surefoot.dashboard.engine.worker import InlineWorker, Reply, Request, RunSpec, Worker, WorkerLostError
from surefoot.dashboard.messages.snapshot import Snapshot


class LaneState(Enum):
    """Whether there is a robot."""

    IDLE = "idle"
    STARTING = "starting"
    RUNNING = "running"


class Lane:
    """Starts its worker when one is wanted, keeps it from one run to the next, and replaces one that was lost.

    Args:
        spawn: makes a worker without a run; OSError when it cannot.
        worker: one that has a run.

    Attributes:
        state: see ``LaneState``.
        spec: the run to start, while it is starting.
        reply, snapshot: the last ones; those of before while it starts again.
    """

    def __init__(self, spawn: Callable[[], Worker], worker: Worker | None = None) -> None:
        self._spawn, self.worker = spawn, worker
        self.state = LaneState.IDLE
        self.spec: RunSpec | None = None
        self.reply: Reply | None = None
        self.snapshot: Snapshot | None = None

    @property
    def running(self) -> bool:
        """Whether there is a run to send requests to."""
        return self.state is LaneState.RUNNING

    @property
    def starting(self) -> bool:
        """Whether one is wanted that is not there yet."""
        return self.state is LaneState.STARTING

    def want(self, spec: RunSpec) -> None:
        """Ask for a run; ``try_start`` begins it."""
        self.spec, self.state = spec, LaneState.STARTING
        if self.worker is None:
            self.worker = self._spawned()

    def try_start(self, request: Request) -> Reply | None:
        """Begin a run as soon as the worker's process is there; None before.

        Raises:
            WorkerLostError: the process has ended; there is no worker now.
            SurefootError: the run cannot be begun; one that went on before goes on.
        """
        assert self.worker is not None
        try:
            if not self.worker.ready():
                return None
            self.worker.begin(request)
            reply = self.worker.finish()
        except WorkerLostError:
            self.close()
            raise
        self.take(reply)
        return reply

    def start_inline(self, request: Request) -> Reply:
        """Begin a run in this process: the last resort. Raises SurefootError."""
        self.worker = InlineWorker()
        self.worker.begin(request)
        reply = self.worker.finish()
        self.take(reply)
        return reply

    def exchange(self, request: Request) -> Callable[[], Reply | WorkerLostError]:
        """Hand over a request; what is returned waits for the result."""
        assert self.worker is not None
        worker = self.worker
        try:
            worker.begin(request)
        except WorkerLostError as error:
            lost = error
            return lambda: lost

        def finish() -> Reply | WorkerLostError:
            try:
                return worker.finish()
            except WorkerLostError as error:
                return error

        return finish

    def take(self, reply: Reply) -> None:
        """Remember a reply."""
        self.reply, self.snapshot = reply, reply.snapshot or self.snapshot
        self.spec, self.state = None, LaneState.RUNNING

    def restart(self) -> None:
        """Replace a worker that was lost: the same run is wanted again."""
        assert self.reply is not None
        self.close()
        self.want(self.reply.spec)

    def give_up(self) -> None:
        """No longer want what could not be begun; a run of before goes on where its worker is still there."""
        if self.worker is None or self.reply is None:
            self.stop()
        else:
            self.spec, self.state = None, LaneState.RUNNING

    def stop(self) -> None:
        """No robot here any more; the worker waits for the next one."""
        self.spec = self.reply = self.snapshot = None
        self.state = LaneState.IDLE

    def close(self) -> None:
        """End the worker."""
        if self.worker is not None:
            self.worker.close()
        self.worker = None

    def _spawned(self) -> Worker:
        try:
            return self._spawn()
        except OSError:  # no process could be started: slower, but it works
            return InlineWorker()
