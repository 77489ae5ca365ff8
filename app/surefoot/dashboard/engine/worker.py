"""Runs the simulation on request: commands to obey, ticks to make; in this process or in one of its own."""

import traceback
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.live.undo import UndoStack
from surefoot.dashboard.messages.command_base import Command
from surefoot.dashboard.messages.commands import Step
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.signals import COMPARED
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.errors import SurefootError
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.experiments.scenario.scenario import Scenario


class WorkerLostError(SurefootError):
    """The process that simulated is gone."""


@dataclass(frozen=True)
class RunSpec:
    """What a run can be made from again.

    Attributes:
        scenario, controller: see ``LiveRun``.
        changes: settings that the user changed.
        friction: None for the scenario's own.
        speed: simulated seconds per second.
        undo: changes of settings that can be undone.
        robot_file: see ``Playback``.
    """

    scenario: Scenario
    controller: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    friction: float | None = None
    speed: float = 1.0
    undo: UndoStack = field(default_factory=UndoStack)
    robot_file: str | None = None


@dataclass(frozen=True, kw_only=True)
class Request:
    """What a worker is to do next, in this order.

    Attributes:
        start: begin this run in place of the one before.
        notes: lines for the log.
        commands: to obey.
        ticks: to make, as long as the run plays.
        snapshot: whether the reply brings one.
        rows: whether it brings the new rows of ``COMPARED``.
        export_run: whether it brings all that the recorder has.
    """

    start: RunSpec | None = None
    notes: tuple[Event, ...] = ()
    commands: tuple[Command, ...] = ()
    ticks: int = 0
    snapshot: bool = False
    rows: bool = False
    export_run: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class Reply:
    """Result of a request.

    Attributes:
        ticks_done: for the clock (those of a ``Step`` do not count).
        time_s, run, playing, speed, ended: of the run, afterwards.
        errors: unexpected exceptions; each paused the run.
        new_events: lines that the log gained, oldest first.
        spec: what the run could be made from again.
        snapshot: when one was asked for.
        rows: (n, len(COMPARED)), when asked for.
        saved: the run, when asked for.
    """

    ticks_done: int
    time_s: float
    run: int
    playing: bool
    speed: float
    ended: bool
    errors: int
    new_events: tuple[Event, ...]
    spec: RunSpec
    snapshot: Snapshot | None
    rows: np.ndarray | None
    saved: SavedRun | None = None


class Worker(Protocol):
    """Simulates one run. ``begin`` and ``finish`` alternate, so that two can work at the same time."""

    def ready(self) -> bool:
        """Whether a request would be begun at once. Raises WorkerLostError."""
        ...

    def begin(self, request: Request) -> None:
        """Hand over a request. Raises WorkerLostError."""
        ...

    def finish(self) -> Reply:
        """Wait for its result. Raises WorkerLostError; SurefootError when ``start`` cannot be done."""
        ...

    def close(self) -> None:
        """End it; may be called twice."""
        ...


class RequestRunner:
    """Carries out requests, in whatever process it is.

    Args:
        playback: to go on with; without, the first request must bring a run spec.
    """

    def __init__(self, playback: Playback | None = None) -> None:
        self.playback = playback
        self._spec: RunSpec | None = None

    def run(self, request: Request) -> Reply:
        """Carry out one request. Raises InvalidInput, PostureError when ``start`` cannot be done."""
        if request.start is not None:
            spec = request.start
            self.playback = Playback(
                spec.scenario, spec.controller, spec.changes, spec.friction, spec.undo, spec.robot_file
            )
            self.playback.speed = spec.speed
        if self.playback is None:
            raise RuntimeError("the first request brings no run spec")
        playback, live = self.playback, self.playback.live
        before = live.log.events
        for note in request.notes:
            live.log.add(note.time_s, note.kind, note.text)
        ticks_done = errors = 0
        try:
            for command in request.commands:
                playback.apply(command)
            while ticks_done < request.ticks and playback.playing:
                playback.tick()
                ticks_done += 1
        except Exception:  # a bug must not end the page: it is logged, and the simulation stands still
            errors, playback.playing = 1, False
            live.say(EventKind.ERROR, "internal error, paused: Reset goes on")
            traceback.print_exc()
        stepped = sum(command.ahead for command in request.commands if isinstance(command, Step))
        return Reply(
            ticks_done=ticks_done,
            time_s=live.simulation.time_s,
            run=playback.runs,
            playing=playback.playing,
            speed=playback.speed,
            ended=live.ended,
            errors=errors,
            new_events=_new_events(before, live.log.events),
            spec=self.spec_of(playback),
            snapshot=playback.snapshot() if request.snapshot else None,
            rows=_compared_rows(playback, ticks_done + stepped) if request.rows else None,
            saved=playback.saved_run() if request.export_run else None,
        )

    def spec_of(self, playback: Playback) -> RunSpec:
        """What a run could be made from again; the same object until that changes."""
        live = playback.live
        spec = RunSpec(
            live.scenario,
            live.controller,
            live.changes,
            live.friction,
            playback.speed,
            live.undo,
            playback.robot_file,
        )
        if self._spec is None or spec != self._spec:
            self._spec = spec
        return self._spec


class InlineWorker:
    """Simulates in this process, at once.

    Args:
        playback: see ``RequestRunner``.
    """

    def __init__(self, playback: Playback | None = None) -> None:
        self._runner = RequestRunner(playback)
        self._done: Reply | None = None

    @property
    def playback(self) -> Playback | None:
        """What it simulates."""
        return self._runner.playback

    def ready(self) -> bool:
        """Always."""
        return True

    def begin(self, request: Request) -> None:
        """Carry it out."""
        self._done = self._runner.run(request)

    def finish(self) -> Reply:
        """Its result."""
        if self._done is None:
            raise RuntimeError("nothing was begun")
        done, self._done = self._done, None
        return done

    def close(self) -> None:
        """Nothing to do."""


def _compared_rows(playback: Playback, ticks: int) -> np.ndarray:
    """The newest ticks as the recorder has them."""
    simulation = playback.live.simulation
    if simulation.stopped:  # the tick that found it was not recorded
        ticks = 0
    recorder = simulation.recorder
    return recorder.last(ticks)[:, [recorder.columns.index(name) for name in COMPARED]]


def _new_events(before: tuple[Event, ...], after: tuple[Event, ...]) -> tuple[Event, ...]:
    if after is before:
        return ()
    known = {id(event) for event in before}
    return tuple(event for event in reversed(after) if id(event) not in known)
