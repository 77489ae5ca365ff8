"""The workers: one for the first robot, and one for its twin from the first time that it is wanted."""

from collections.abc import Callable

from surefoot.dashboard.engine.worker import InlineWorker, Reply, Request, RunSpec, Worker, WorkerLostError


class WorkerPool:
    """Keeps them, makes two work at the same time, and replaces one that was lost.

    Args:
        first: has a live run already.
        spawn: makes another worker, one without a live run; OSError when it cannot.
    """

    def __init__(self, first: Worker, spawn: Callable[[], Worker]) -> None:
        self._first, self._spawn = first, spawn
        self._twin: Worker | None = None  # kept when a twin run stops: the next one starts at once

    def perform(self, first: Request, twin: Request | None = None) -> list[Reply | WorkerLostError]:
        """What came of each request; both are played at the same time."""
        jobs = [(self._first, first)]
        if twin is not None:
            assert self._twin is not None
            jobs.append((self._twin, twin))
        begun: list[WorkerLostError | None] = [_begin(worker, request) for worker, request in jobs]
        return [lost or _finish(worker) for (worker, _), lost in zip(jobs, begun, strict=True)]

    def start_twin(self, spec: Callable[[], RunSpec]) -> Reply | None:
        """Give the twin a live run as soon as it has a process; None before.

        Raises:
            LostPerformerError: its process has ended.
            SurefootError: the run spec cannot be played.
        """
        if self._twin is None:
            self._twin = self._spawned()
        try:
            return _adopted(self._twin, Request(start=spec(), picture=True)) if self._twin.ready() else None
        except WorkerLostError:
            self.stop_twin()
            raise

    def stop_twin(self) -> None:
        """End the twin's process."""
        if self._twin is not None:
            self._twin.close()
        self._twin = None

    def replace_first(self) -> None:
        """Start the first robot's process again."""
        self._first.close()
        self._first = self._spawned()

    def start_first(self, request: Request) -> Reply | None:
        """Give the new first worker its live run as soon as it has a process; None before.

        A process that cannot be started twice is given up: this one plays itself.
        """
        try:
            return _adopted(self._first, request) if self._first.ready() else None
        except WorkerLostError:
            self._first.close()
            self._first = InlineWorker()
            return _adopted(self._first, request)

    def close(self) -> None:
        """End all processes."""
        self._first.close()
        self.stop_twin()

    def _spawned(self) -> Worker:
        try:
            return self._spawn()
        except OSError:  # no process to be had: slower, but it works
            return InlineWorker()


def _begin(worker: Worker, request: Request) -> WorkerLostError | None:
    try:
        worker.begin(request)
    except WorkerLostError as error:
        return error
    return None


def _finish(worker: Worker) -> Reply | WorkerLostError:
    try:
        return worker.finish()
    except WorkerLostError as error:
        return error


def _adopted(worker: Worker, request: Request) -> Reply:
    worker.begin(request)
    return worker.finish()
