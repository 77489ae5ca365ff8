"""The performers: one for the first robot, and one for its twin from the first time that it is wanted."""

from collections.abc import Callable

from surefoot.dashboard.engine.worker import Batch, LocalPerformer, LostPerformerError, Performer, Recipe, Report


class Ensemble:
    """Keeps them, makes two work at the same time, and replaces one that was lost.

    Args:
        first: has a stage already.
        hire: makes another performer, one without a stage; OSError when it cannot.
    """

    def __init__(self, first: Performer, hire: Callable[[], Performer]) -> None:
        self._first, self._hire = first, hire
        self._twin: Performer | None = None  # kept when a twin run stops: the next one starts at once

    def perform(self, first: Batch, twin: Batch | None = None) -> list[Report | LostPerformerError]:
        """What came of each batch; both are played at the same time."""
        jobs = [(self._first, first)]
        if twin is not None:
            assert self._twin is not None
            jobs.append((self._twin, twin))
        begun: list[LostPerformerError | None] = [_begin(performer, batch) for performer, batch in jobs]
        return [lost or _finish(performer) for (performer, _), lost in zip(jobs, begun, strict=True)]

    def adopt_twin(self, recipe: Callable[[], Recipe]) -> Report | None:
        """Give the twin a stage as soon as it has a process; None before.

        Raises:
            LostPerformerError: its process has ended.
            SurefootError: the recipe cannot be played.
        """
        if self._twin is None:
            self._twin = self._hired()
        try:
            return _adopted(self._twin, Batch(adopt=recipe(), picture=True)) if self._twin.ready() else None
        except LostPerformerError:
            self.dismiss_twin()
            raise

    def dismiss_twin(self) -> None:
        """End the twin's process."""
        if self._twin is not None:
            self._twin.close()
        self._twin = None

    def replace_first(self) -> None:
        """Start the first robot's process anew."""
        self._first.close()
        self._first = self._hired()

    def adopt_first(self, batch: Batch) -> Report | None:
        """Give the new first performer its stage as soon as it has a process; None before.

        A process that cannot be started twice is given up: this one plays itself.
        """
        try:
            return _adopted(self._first, batch) if self._first.ready() else None
        except LostPerformerError:
            self._first.close()
            self._first = LocalPerformer()
            return _adopted(self._first, batch)

    def close(self) -> None:
        """End all processes."""
        self._first.close()
        self.dismiss_twin()

    def _hired(self) -> Performer:
        try:
            return self._hire()
        except OSError:  # no process to be had: slower, but it works
            return LocalPerformer()


def _begin(performer: Performer, batch: Batch) -> LostPerformerError | None:
    try:
        performer.begin(batch)
    except LostPerformerError as error:
        return error
    return None


def _finish(performer: Performer) -> Report | LostPerformerError:
    try:
        return performer.finish()
    except LostPerformerError as error:
        return error


def _adopted(performer: Performer, batch: Batch) -> Report:
    performer.begin(batch)
    return performer.finish()
