"""The thread that alone owns the simulation: commands in, ticks against the wall clock, snapshots out."""

import queue
import threading
import time
import traceback
from dataclasses import dataclass
from typing import Any

from app.dashboard.commands import ChangeSettings, Command, newest_seeks
from app.dashboard.pacing import Pacer
from app.dashboard.snapshot import Snapshot
from app.dashboard.stage import Stage

PUBLISH_EVERY_S = 1.0 / 60.0
_BATCH_TICKS = 4  # between two looks at the queue
_NAP_S = 0.002
_IDLE_S = 0.02
_GATHER_S = 0.06


@dataclass(frozen=True)
class Statistics:
    """How the session is doing.

    Attributes:
        real_time_factor: simulated seconds per second, over the last second.
        ticks, snapshots: made since the start.
        errors: unexpected exceptions that paused the simulation.
    """

    real_time_factor: float
    ticks: int
    snapshots: int
    errors: int


class Session:
    """Runs a stage in a thread of its own.

    Args:
        stage: what to run; nobody else touches it once ``start`` has been called.
        paced: follow the wall clock; without, tick as fast as possible (tests).
    """

    def __init__(self, stage: Stage, *, paced: bool = True) -> None:
        self._stage, self._paced = stage, paced
        self._commands: queue.SimpleQueue[Command] = queue.SimpleQueue()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="surefoot-session", daemon=True)
        self._pacer = Pacer(time.perf_counter())
        self._ticks = self._snapshots = self._errors = 0
        self._waiting: list[Command] = []
        self._gathered: dict[str, Any] = {}
        self._changed_s = -1.0
        self._snapshot = self._picture()

    @property
    def snapshot(self) -> Snapshot:
        """The newest picture."""
        return self._snapshot

    def send(self, command: Command) -> None:
        """Ask for something; obeyed between two ticks."""
        self._commands.put(command)

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def stop(self) -> None:
        """Stop the thread and wait for it."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join(timeout=5.0)

    def statistics(self) -> Statistics:
        """How the session is doing."""
        return Statistics(self._pacer.real_time_factor, self._ticks, self._snapshots, self._errors)

    def _run(self) -> None:
        published = 0.0
        while not self._stop.is_set():
            try:
                worked = self._turn()
                now = time.perf_counter()
                if now - published >= PUBLISH_EVERY_S:
                    published = now
                    self._snapshot = self._picture()
            except Exception:  # a bug must not end the page: it is told, and the simulation stands still
                worked = False
                self._errors += 1
                self._stage.playing = False
                self._stage.log.add(self._stage.simulation.time_s, "error", "internal error, paused: Reset goes on")
                traceback.print_exc()
            if not worked:
                self._stop.wait(_NAP_S if self._stage.playing else _IDLE_S)

    def _turn(self) -> bool:
        """Obey what waits, make a batch of ticks; False when nothing was due."""
        stage = self._stage
        self._obey()
        due = self._pacer.due(time.perf_counter(), stage.speed, playing=stage.playing)
        if not self._paced and stage.playing:
            due = _BATCH_TICKS
        made = 0
        while made < min(due, _BATCH_TICKS) and stage.playing:
            stage.tick()
            made += 1
        self._ticks += made
        self._pacer.made(made, time.perf_counter())
        return made > 0

    def _obey(self) -> None:
        """Obey what waits. Settings changes of a dragged slider are gathered: each one starts a blend of 50 ms."""
        stage = self._stage
        while not self._commands.empty():
            self._waiting.append(self._commands.get())
        self._waiting = newest_seeks(self._waiting)
        while self._waiting:
            command = self._waiting.pop(0)
            if isinstance(command, ChangeSettings):
                self._gathered.update(command.changes)
            else:
                self._apply_gathered()
                stage.apply(command)
        if not stage.playing or abs(stage.simulation.time_s - self._changed_s) > _GATHER_S:
            self._apply_gathered()

    def _apply_gathered(self) -> None:
        if self._gathered:
            self._stage.apply(ChangeSettings(dict(self._gathered)))
            self._gathered.clear()
            self._changed_s = self._stage.simulation.time_s

    def _picture(self) -> Snapshot:
        stage = self._stage
        self._snapshots += 1
        return Snapshot(
            number=self._snapshots, run=stage.runs, time_s=stage.simulation.time_s, playing=stage.playing,
            speed=stage.speed, real_time_factor=self._pacer.real_time_factor, scenario=stage.scenario.name,
            controller=stage.controller, support=str(stage.scenario.support), settings=stage.settings,
            friction=stage.friction, bias=stage.bias, geometry=stage.observer.geometry(),
            verdict=stage.observer.verdict(ended=stage.ended), traces=stage.observer.traces(),
            limits=stage.observer.limits, events=stage.log.events, timeline=stage.history.view(),
            headroom=stage.observer.headroom(),
        )  # fmt: skip
