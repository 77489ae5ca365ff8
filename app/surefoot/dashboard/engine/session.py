"""The session's thread: commands in, ticks against the wall clock, snapshots out."""

import os
import queue
import time
import traceback
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

from surefoot.dashboard.engine.coordinator import Coordinator
from surefoot.dashboard.engine.pacing import Pacer
from surefoot.dashboard.engine.threads import SIMULATES, LoopThread
from surefoot.dashboard.engine.worker import InlineWorker, Worker, WorkerLostError
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages.command_check import check_command
from surefoot.dashboard.messages.commands import ChangeSettings, ChangeTwinSettings, Command, Refused, Seek
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.saved_run import SavedRun

PUBLISH_EVERY_S = 1.0 / 60.0
_LEAST_TICKS, _MOST_TICKS = 20, 32  # of a request without a snapshot: each costs 0.3 ms, and commands wait for its end
_NAP_S = 0.002
_IDLE_S = 0.02
# Pauses of a simulation that cannot keep up, as a share of its work. Where it shares its core with whoever draws, these
# must get something of it; where it has one to itself, just enough that the real-time scheduler does not stop it, which
# takes 50 ms of a second from a thread that asks for more than 95 % of it.
_SHARED_CORE, _OWN_CORE = 0.25, 0.05
_GATHER_S = 0.06
_GATHERED = (ChangeSettings, ChangeTwinSettings)
PAUSE_S = 1.5  # of the wall clock; a hand that rests longer begins again


class SliderDrags:
    """Numbers the drags of sliders: changes that follow each other closely and share a setting belong to one."""

    def __init__(self) -> None:
        self._number = 0
        self._names: frozenset[str] = frozenset()
        self._latest_s = float("-inf")

    def number(self, names: Iterable[str], now_s: float) -> int:
        """The drag that a change of these settings belongs to, 1 or more.

        Args:
            names: settings that change.
            now_s: wall clock.
        """
        changed = frozenset(names)
        if now_s - self._latest_s > PAUSE_S or not changed & self._names:
            self._number, self._names = self._number + 1, frozenset()
        self._names |= changed
        self._latest_s = now_s
        return self._number

    def end(self) -> None:
        """Something else happened: whatever comes next is another drag."""
        self._latest_s = float("-inf")


@dataclass(frozen=True)
class Statistics:
    """How the session is doing.

    Attributes:
        real_time_factor: simulated seconds per second, over the last second.
        ticks, snapshots: made since the start.
        errors: unexpected exceptions that paused the simulation, and workers lost.
    """

    real_time_factor: float
    ticks: int
    snapshots: int
    errors: int


class Session:
    """Runs one robot, or two, from a thread of its own.

    Args:
        first: a playback, run in this process, or a worker that has one; nobody else touches it from now on.
        spawn: makes workers for a twin and in place of a lost one; OSError when it cannot.
        paced: follow the wall clock; without, tick as fast as possible (tests).
    """

    def __init__(
        self, first: Playback | Worker, *, spawn: Callable[[], Worker] = InlineWorker, paced: bool = True
    ) -> None:
        worker = InlineWorker(first) if isinstance(first, Playback) else first
        self._coordinator = Coordinator(worker, spawn)
        self._paced = paced
        self._cores = 1 if isinstance(worker, InlineWorker) else _cores()  # in this process, one thread runs at a time
        self._commands: queue.SimpleQueue[Command] = queue.SimpleQueue()
        self._questions: queue.SimpleQueue[Future[SavedRun]] = queue.SimpleQueue()
        self._loop = LoopThread("surefoot-session", self._round, level=SIMULATES if paced else None)
        self._pacer = Pacer(time.perf_counter())
        self._ticks = self._snapshots = self._errors = 0
        self._gathered: dict[type, dict[str, Any]] = {}
        self._slider_drags = SliderDrags()
        self._changed_s = -1.0
        self._changed = False
        self._published = 0.0
        self._snapshot = self._newest()

    @property
    def snapshot(self) -> Snapshot:
        """The newest snapshot."""
        return self._snapshot

    def send(self, command: Command) -> None:
        """Ask for something; obeyed between two ticks. What makes no sense is told in the log instead."""
        try:
            check_command(command)
        except InvalidInput as error:
            command = Refused(str(error))
        self._commands.put(command)

    def saved_run(self) -> "Future[SavedRun]":
        """Ask for the last seconds of the run as data; the answer comes between two ticks."""
        answer: Future[SavedRun] = Future()
        self._questions.put(answer)
        return answer

    def start(self) -> None:
        """Start the thread."""
        self._loop.start()

    def stop(self) -> None:
        """Stop the thread, wait for it, and end the workers."""
        self._loop.stop()
        self._coordinator.close()

    def statistics(self) -> Statistics:
        """How the session is doing."""
        return Statistics(self._pacer.real_time_factor, self._ticks, self._snapshots, self._errors)

    def _round(self) -> float:
        """A turn, and how long to wait after it [s]."""
        started = time.perf_counter()
        try:
            worked = self._turn()
        except Exception:  # counted, and soon tried again
            worked = False
            self._errors += 1
            traceback.print_exc()
        if not worked:
            return _NAP_S if self._coordinator.playing else _IDLE_S
        if self._paced and self._pacer.behind:
            own = self._coordinator.robots < self._cores
            return (_OWN_CORE if own else _SHARED_CORE) * (time.perf_counter() - started)
        return 0.0

    def _turn(self) -> bool:
        """One request; False when nothing was due."""
        coordinator = self._coordinator
        commands = [] if coordinator.waiting else self._taken()
        now = time.perf_counter()
        due = self._pacer.due(now, coordinator.speed, playing=coordinator.playing)
        if not self._paced and coordinator.playing:
            due = _MOST_TICKS
        publish = now - self._published >= PUBLISH_EVERY_S
        if publish:
            self._published = now
        snapshot = publish and (coordinator.playing or self._changed)
        ticks = min(due, _MOST_TICKS) if due >= _LEAST_TICKS or commands or snapshot else 0
        export_run = not self._questions.empty() and not coordinator.waiting
        done = coordinator.turn(commands, ticks, snapshot=snapshot, export_run=export_run)
        if export_run:
            self._answer(done.saved)
        self._changed = bool(done.ticks or done.errors or commands) or (self._changed and not snapshot)
        self._ticks += done.ticks
        self._errors += done.errors
        self._pacer.advanced(done.ticks, time.perf_counter())
        if publish:
            self._snapshot = self._newest()
        return done.ticks > 0

    def _taken(self) -> list[Command]:
        """What waits. Settings changes of a dragged slider are gathered: each one starts a blend of 50 ms."""
        waiting, taken = [], []
        while not self._commands.empty():
            waiting.append(self._commands.get())
        for command in _newest_seeks(waiting):
            if isinstance(command, _GATHERED):
                self._gathered.setdefault(type(command), {}).update(command.changes)
            else:
                taken += [*self._released(), command]
                self._slider_drags.end()
        coordinator = self._coordinator
        if not coordinator.playing or abs(coordinator.time_s - self._changed_s) > _GATHER_S:
            taken += self._released()
        return taken

    def _released(self) -> list[Command]:
        if not self._gathered:
            return []
        changes, self._gathered = self._gathered, {}
        self._changed_s = self._coordinator.time_s
        return [
            ChangeSettings(values, self._slider_drags.number(values, time.perf_counter()))
            if kind is ChangeSettings
            else kind(values)
            for kind, values in changes.items()
        ]

    def _answer(self, saved: SavedRun | None) -> None:
        while not self._questions.empty():
            question = self._questions.get()
            if saved is None:
                question.set_exception(WorkerLostError("the process that simulates has ended: the run is lost"))
            else:
                question.set_result(saved)

    def _newest(self) -> Snapshot:
        self._snapshots += 1
        return self._coordinator.snapshot(self._snapshots, self._pacer.real_time_factor)


def _cores() -> int:
    """How many this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _newest_seeks(commands: Iterable[Command]) -> list[Command]:
    """Commands in order, without every ``Seek`` that another one follows: a dragged slider sends more than needed."""
    found: list[Command] = []
    for command in commands:
        if isinstance(command, Seek) and found and isinstance(found[-1], Seek):
            found.pop()
        found.append(command)
    return found
