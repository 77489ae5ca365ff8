"""The thread that conducts the performance: commands in, ticks against the wall clock, snapshots out."""

import queue
import threading
import time
import traceback
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

from surefoot.dashboard.engine.coordinator import Conductor
from surefoot.dashboard.engine.pacing import Pacer
from surefoot.dashboard.engine.slider_drags import Strokes
from surefoot.dashboard.engine.thread_priority import SIMULATES, prefer
from surefoot.dashboard.engine.worker import LocalPerformer, LostPerformerError, Performer
from surefoot.dashboard.engine.worker_pool import Ensemble
from surefoot.dashboard.live.live_run import Stage
from surefoot.dashboard.messages.commands import ChangeSettings, ChangeTwinSettings, Command, newest_seeks
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.experiments.runs.saved_run import SavedRun

PUBLISH_EVERY_S = 1.0 / 60.0
_LEAST_TICKS, _MOST_TICKS = 20, 32  # of a batch without a picture: each costs 0.3 ms, and commands wait for its end
_NAP_S = 0.002
_IDLE_S = 0.02
_BREATH = 0.25
_GATHER_S = 0.06
_GATHERED = (ChangeSettings, ChangeTwinSettings)


@dataclass(frozen=True)
class Statistics:
    """How the session is doing.

    Attributes:
        real_time_factor: simulated seconds per second, over the last second.
        ticks, snapshots: made since the start.
        errors: unexpected exceptions that paused the simulation, and performers lost.
    """

    real_time_factor: float
    ticks: int
    snapshots: int
    errors: int


class Session:
    """Conducts one robot, or two, from a thread of its own.

    Args:
        first: a stage, played in this process, or a performer that has one; nobody else touches it from now on.
        hire: makes performers for a twin and in place of a lost one; OSError when it cannot.
        paced: follow the wall clock; without, tick as fast as possible (tests).
    """

    def __init__(
        self, first: Stage | Performer, *, hire: Callable[[], Performer] = LocalPerformer, paced: bool = True
    ) -> None:
        performer = LocalPerformer(first) if isinstance(first, Stage) else first
        self._conductor = Conductor(Ensemble(performer, hire))
        self._paced = paced
        self._commands: queue.SimpleQueue[Command] = queue.SimpleQueue()
        self._questions: queue.SimpleQueue[Future[SavedRun]] = queue.SimpleQueue()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="surefoot-session", daemon=True)
        self._pacer = Pacer(time.perf_counter())
        self._ticks = self._snapshots = self._errors = 0
        self._gathered: dict[type, dict[str, Any]] = {}
        self._strokes = Strokes()
        self._changed_s = -1.0
        self._changed = False
        self._published = 0.0
        self._snapshot = self._picture()

    @property
    def snapshot(self) -> Snapshot:
        """The newest picture."""
        return self._snapshot

    def send(self, command: Command) -> None:
        """Ask for something; obeyed between two ticks."""
        self._commands.put(command)

    def saved_run(self) -> "Future[SavedRun]":
        """Ask for the last seconds of the run as data; the answer comes between two ticks."""
        answer: Future[SavedRun] = Future()
        self._questions.put(answer)
        return answer

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def stop(self) -> None:
        """Stop the thread, wait for it, and end the performers."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join(timeout=5.0)
        self._conductor.close()

    def statistics(self) -> Statistics:
        """How the session is doing."""
        return Statistics(self._pacer.real_time_factor, self._ticks, self._snapshots, self._errors)

    def _run(self) -> None:
        if self._paced:
            prefer(SIMULATES)
        while not self._stop.is_set():
            started = time.perf_counter()
            try:
                worked = self._turn()
            except Exception:  # a bug must not end the page
                worked = False
                self._errors += 1
                traceback.print_exc()
            if not worked:
                self._stop.wait(_NAP_S if self._conductor.playing else _IDLE_S)
            elif self._paced and self._pacer.behind:  # too slow a machine: whoever draws must get a share of it
                self._stop.wait(_BREATH * (time.perf_counter() - started))

    def _turn(self) -> bool:
        """One batch; False when nothing was due."""
        conductor = self._conductor
        commands = [] if conductor.waiting else self._taken()
        now = time.perf_counter()
        due = self._pacer.due(now, conductor.speed, playing=conductor.playing)
        if not self._paced and conductor.playing:
            due = _MOST_TICKS
        publish = now - self._published >= PUBLISH_EVERY_S
        if publish:
            self._published = now
        picture = publish and (conductor.playing or self._changed)
        ticks = min(due, _MOST_TICKS) if due >= _LEAST_TICKS or commands or picture else 0
        keep = not self._questions.empty() and not conductor.waiting
        made, errors = conductor.turn(commands, ticks, picture=picture, keep=keep)
        if keep:
            self._answer(conductor.saved)
        self._changed = bool(made or errors or commands) or (self._changed and not picture)
        self._ticks += made
        self._errors += errors
        self._pacer.made(made, time.perf_counter())
        if publish:
            self._snapshot = self._picture()
        return made > 0

    def _taken(self) -> list[Command]:
        """What waits. Settings changes of a dragged slider are gathered: each one starts a blend of 50 ms."""
        waiting, taken = [], []
        while not self._commands.empty():
            waiting.append(self._commands.get())
        for command in newest_seeks(waiting):
            if isinstance(command, _GATHERED):
                self._gathered.setdefault(type(command), {}).update(command.changes)
            else:
                taken += [*self._released(), command]
                self._strokes.end()
        conductor = self._conductor
        if not conductor.playing or abs(conductor.time_s - self._changed_s) > _GATHER_S:
            taken += self._released()
        return taken

    def _released(self) -> list[Command]:
        if not self._gathered:
            return []
        changes, self._gathered = self._gathered, {}
        self._changed_s = self._conductor.time_s
        return [
            ChangeSettings(values, self._strokes.number(values, time.perf_counter())) if kind is ChangeSettings
            else kind(values) for kind, values in changes.items()
        ]  # fmt: skip

    def _answer(self, saved: SavedRun | None) -> None:
        while not self._questions.empty():
            question = self._questions.get()
            if saved is None:
                question.set_exception(LostPerformerError("the process that simulates has ended: the run is lost"))
            else:
                question.set_result(saved)

    def _picture(self) -> Snapshot:
        self._snapshots += 1
        return self._conductor.snapshot(self._snapshots, self._pacer.real_time_factor)
