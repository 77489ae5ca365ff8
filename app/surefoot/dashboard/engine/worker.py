"""Who plays a stage: told in batches what to obey and how many ticks to make, in this process or in one of its own."""

import traceback
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from surefoot.dashboard.live.live_run import Stage
from surefoot.dashboard.live.observation.take_snapshot import picture_of
from surefoot.dashboard.live.undo import UndoStack
from surefoot.dashboard.messages.commands import Command, Step
from surefoot.dashboard.messages.events import Event
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.errors import SurefootError
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.experiments.scenario.scenario import Scenario

COMPARED = (
    "time_s", "com_x_m", "com_y_m", "com_z_m", "zmp_margin_m", "delta_measured_x_nm", "delta_measured_y_nm",
)  # fmt: skip


class LostPerformerError(SurefootError):
    """The process that played a stage is gone."""


@dataclass(frozen=True)
class Recipe:
    """What a stage can be made from again.

    Attributes:
        scenario, controller: see ``Stage``.
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
class Batch:
    """What a performer is to do next, in this order.

    Attributes:
        adopt: put another stage into the place of the one before.
        notes: lines for the log.
        commands: to obey.
        ticks: to make, as long as the stage plays.
        picture: whether the report brings a picture.
        rows: whether it brings the batch's rows of ``COMPARED``.
        keep: whether it brings all that the recorder has.
    """

    adopt: Recipe | None = None
    notes: tuple[Event, ...] = ()
    commands: tuple[Command, ...] = ()
    ticks: int = 0
    picture: bool = False
    rows: bool = False
    keep: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class Report:
    """What came of a batch.

    Attributes:
        made: ticks made for the clock (those of a ``Step`` are not).
        time_s, run, playing, speed, ended: of the stage, afterwards.
        errors: unexpected exceptions; each paused the stage.
        news: lines that the log gained, oldest first.
        recipe: what the stage could be made from again.
        picture: when one was asked for.
        rows: (n, len(COMPARED)), when asked for.
        saved: the run, when asked for.
    """

    made: int
    time_s: float
    run: int
    playing: bool
    speed: float
    ended: bool
    errors: int
    news: tuple[Event, ...]
    recipe: Recipe
    picture: Snapshot | None
    rows: np.ndarray | None
    saved: SavedRun | None = None


class Performer(Protocol):
    """Plays one stage. ``begin`` and ``finish`` alternate, so that two can work at the same time."""

    def ready(self) -> bool:
        """Whether a batch would be begun at once. Raises LostPerformerError."""
        ...

    def begin(self, batch: Batch) -> None:
        """Ask for a batch. Raises LostPerformerError."""
        ...

    def finish(self) -> Report:
        """Wait for what came of it. Raises LostPerformerError; SurefootError when ``adopt`` cannot be done."""
        ...

    def close(self) -> None:
        """End it; may be called twice."""
        ...


class Player:
    """Plays batches on a stage, wherever it is.

    Args:
        stage: what to play on; without, the first batch must bring a recipe.
    """

    def __init__(self, stage: Stage | None = None) -> None:
        self._stage = stage
        self._recipe: Recipe | None = None

    def play(self, batch: Batch) -> Report:
        """Play one batch. Raises InvalidInput, PostureError when ``adopt`` cannot be done."""
        if batch.adopt is not None:
            recipe = batch.adopt
            self._stage = Stage(recipe.scenario, recipe.controller, recipe.changes, recipe.friction, recipe.undo)
            self._stage.speed = recipe.speed
        if self._stage is None:
            raise RuntimeError("the first batch brings no recipe")
        stage, before = self._stage, self._stage.log.events
        for note in batch.notes:
            stage.log.add(note.time_s, note.kind, note.text)
        made = errors = 0
        try:
            for command in batch.commands:
                stage.apply(command)
            while made < batch.ticks and stage.playing:
                stage.tick()
                made += 1
        except Exception:  # a bug must not end the page: it is told, and the simulation stands still
            errors, stage.playing = 1, False
            stage.log.add(stage.simulation.time_s, "error", "internal error, paused: Reset goes on")
            traceback.print_exc()
        stepped = sum(min(max(command.ticks, 0), 1000) for command in batch.commands if isinstance(command, Step))
        return Report(
            made=made, time_s=stage.simulation.time_s, run=stage.runs, playing=stage.playing, speed=stage.speed,
            ended=stage.ended, errors=errors, news=_news(before, stage.log.events), recipe=self._recipe_of(stage),
            picture=picture_of(stage) if batch.picture else None,
            rows=self._rows(stage, made + stepped) if batch.rows else None,
            saved=stage.saved_run() if batch.keep else None,
        )  # fmt: skip

    def _recipe_of(self, stage: Stage) -> Recipe:
        recipe = Recipe(stage.scenario, stage.controller, stage.changes, stage.friction, stage.speed, stage.undo)
        if self._recipe is None or recipe != self._recipe:
            self._recipe = recipe
        return self._recipe

    def _rows(self, stage: Stage, ticks: int) -> np.ndarray:
        """The newest ticks as the recorder has them."""
        recorder = stage.simulation.recorder
        columns = [recorder.columns.index(name) for name in COMPARED]
        if stage.simulation.fallen == "nan":  # the tick that found it was not recorded
            ticks = 0
        return recorder.last(ticks)[:, columns]


class LocalPerformer:
    """Plays in this process, at once.

    Args:
        stage: what to play on; without, the first batch must bring a recipe.
    """

    def __init__(self, stage: Stage | None = None) -> None:
        self._player = Player(stage)
        self._done: Report | None = None

    def ready(self) -> bool:
        """Always."""
        return True

    def begin(self, batch: Batch) -> None:
        """Play it."""
        self._done = self._player.play(batch)

    def finish(self) -> Report:
        """What came of it."""
        if self._done is None:
            raise RuntimeError("nothing was begun")
        done, self._done = self._done, None
        return done

    def close(self) -> None:
        """Nothing to do."""


def _news(before: tuple[Event, ...], after: tuple[Event, ...]) -> tuple[Event, ...]:
    if after is before:
        return ()
    known = {id(event) for event in before}
    return tuple(event for event in reversed(after) if id(event) not in known)
