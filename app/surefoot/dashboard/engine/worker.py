"""Runs the simulation on request: commands to obey, ticks to make; in this process or in one of its own."""

import traceback
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.observation.take_snapshot import take_snapshot
from surefoot.dashboard.live.undo import UndoStack
from surefoot.dashboard.messages.commands import Command, Step
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.errors import SurefootError
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.experiments.scenario.scenario import Scenario

COMPARED = (
    "time_s", "com_x_m", "com_y_m", "com_z_m", "zmp_margin_m", "delta_measured_x_nm", "delta_measured_y_nm",
)  # fmt: skip


class WorkerLostError(SurefootError):
    """The process that played a live run is gone."""


@dataclass(frozen=True)
class RunSpec:
    """What a live run can be made from again.

    Attributes:
        scenario, controller: see ``LiveRun``.
        changes: settings that a person changed.
        friction: None for the scenario's own.
        speed: simulated seconds per second.
        undo: changes of settings that can be undone.
    """

    scenario: Scenario
    controller: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    friction: float | None = None
    speed: float = 1.0
    undo: UndoStack = field(default_factory=UndoStack)


@dataclass(frozen=True, kw_only=True)
class Request:
    """What a worker is to do next, in this order.

    Attributes:
        start: put another live run into the place of the one before.
        notes: lines for the log.
        commands: to obey.
        ticks: to make, as long as the live run plays.
        picture: whether the reply brings a picture.
        rows: whether it brings the request's rows of ``COMPARED``.
        export_run: whether it brings all that the recorder has.
    """

    start: RunSpec | None = None
    notes: tuple[Event, ...] = ()
    commands: tuple[Command, ...] = ()
    ticks: int = 0
    picture: bool = False
    rows: bool = False
    export_run: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class Reply:
    """What came of a request.

    Attributes:
        ticks_done: ticks made for the clock (those of a ``Step`` are not).
        time_s, run, playing, speed, ended: of the live run, afterwards.
        errors: unexpected exceptions; each paused the live run.
        new_events: lines that the log gained, oldest first.
        spec: what the live run could be made from again.
        picture: when one was asked for.
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
    picture: Snapshot | None
    rows: np.ndarray | None
    saved: SavedRun | None = None


class Worker(Protocol):
    """Plays one live run. ``begin`` and ``finish`` alternate, so that two can work at the same time."""

    def ready(self) -> bool:
        """Whether a request would be begun at once. Raises LostPerformerError."""
        ...

    def begin(self, request: Request) -> None:
        """Ask for a request. Raises LostPerformerError."""
        ...

    def finish(self) -> Reply:
        """Wait for what came of it. Raises LostPerformerError; SurefootError when ``start`` cannot be done."""
        ...

    def close(self) -> None:
        """End it; may be called twice."""
        ...


class BatchRunner:
    """Plays requests on a live run, wherever it is.

    Args:
        live: what to play on; without, the first request must bring a run spec.
    """

    def __init__(self, live: LiveRun | None = None) -> None:
        self._live = live
        self._spec: RunSpec | None = None

    def play(self, request: Request) -> Reply:
        """Play one request. Raises InvalidInput, PostureError when ``start`` cannot be done."""
        if request.start is not None:
            spec = request.start
            self._live = LiveRun(spec.scenario, spec.controller, spec.changes, spec.friction, spec.undo)
            self._live.speed = spec.speed
        if self._live is None:
            raise RuntimeError("the first batch brings no recipe")
        live, before = self._live, self._live.log.events
        for note in request.notes:
            live.log.add(note.time_s, note.kind, note.text)
        ticks_done = errors = 0
        try:
            for command in request.commands:
                live.apply(command)
            while ticks_done < request.ticks and live.playing:
                live.tick()
                ticks_done += 1
        except Exception:  # a bug must not end the page: it is told, and the simulation stands still
            errors, live.playing = 1, False
            live.log.add(live.simulation.time_s, EventKind.ERROR, "internal error, paused: Reset goes on")
            traceback.print_exc()
        stepped = sum(min(max(command.ticks, 0), 1000) for command in request.commands if isinstance(command, Step))
        return Reply(
            ticks_done=ticks_done, time_s=live.simulation.time_s, run=live.runs, playing=live.playing, speed=live.speed,
            ended=live.ended, errors=errors, new_events=_new_events(before, live.log.events), spec=self._spec_of(live),
            picture=take_snapshot(live) if request.picture else None,
            rows=self._rows(live, ticks_done + stepped) if request.rows else None,
            saved=live.saved_run() if request.export_run else None,
        )  # fmt: skip

    def _spec_of(self, live: LiveRun) -> RunSpec:
        spec = RunSpec(live.scenario, live.controller, live.changes, live.friction, live.speed, live.undo)
        if self._spec is None or spec != self._spec:
            self._spec = spec
        return self._spec

    def _rows(self, live: LiveRun, ticks: int) -> np.ndarray:
        """The newest ticks as the recorder has them."""
        recorder = live.simulation.recorder
        columns = [recorder.columns.index(name) for name in COMPARED]
        if live.simulation.fallen == "nan":  # the tick that found it was not recorded
            ticks = 0
        return recorder.last(ticks)[:, columns]


class InlineWorker:
    """Plays in this process, at once.

    Args:
        live: what to play on; without, the first request must bring a run spec.
    """

    def __init__(self, live: LiveRun | None = None) -> None:
        self._runner = BatchRunner(live)
        self._done: Reply | None = None

    def ready(self) -> bool:
        """Always."""
        return True

    def begin(self, request: Request) -> None:
        """Play it."""
        self._done = self._runner.play(request)

    def finish(self) -> Reply:
        """What came of it."""
        if self._done is None:
            raise RuntimeError("nothing was begun")
        done, self._done = self._done, None
        return done

    def close(self) -> None:
        """Nothing to do."""


def _new_events(before: tuple[Event, ...], after: tuple[Event, ...]) -> tuple[Event, ...]:
    if after is before:
        return ()
    known = {id(event) for event in before}
    return tuple(event for event in reversed(after) if id(event) not in known)
