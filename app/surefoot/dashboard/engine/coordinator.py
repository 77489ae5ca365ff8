"""Keeps one robot, or two in step: the same commands at the same tick, the same number of ticks, one picture of all."""

from collections.abc import Sequence
from dataclasses import replace

from surefoot.dashboard.engine.twin_comparison import Comparison
from surefoot.dashboard.engine.twin_routing import for_first, split
from surefoot.dashboard.engine.worker import Reply, Request, RunSpec, WorkerLostError
from surefoot.dashboard.engine.worker_pool import WorkerPool
from surefoot.dashboard.live.undo import UndoStack
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.snapshot import DIVERGED_M, Snapshot, TwinView
from surefoot.errors import SurefootError
from surefoot.experiments.runs.saved_run import SavedRun

_IN_STEP_S = 1e-6


class Coordinator:
    """Gives requests to the workers and puts their replies together.

    Args:
        pool: whose first worker has a live run.

    Raises:
        LostPerformerError: it is gone.
    """

    def __init__(self, pool: WorkerPool) -> None:
        self._pool = pool
        (reply,) = pool.perform(Request(picture=True))
        if isinstance(reply, WorkerLostError):
            raise reply
        assert reply.picture is not None
        self._report, self._picture = reply, reply.picture
        self._other: Reply | None = None
        self._other_picture: Snapshot | None = None
        self._wanted: RunSpec | None = None  # the twin to start as soon as its process is there
        self._lost = False  # the first robot's process is being started again
        self._comparison = Comparison()
        self._notes: list[Event] = []
        self._before_others: list[cmd.Command] = []
        self._runs_before = 0
        self.saved: SavedRun | None = None

    @property
    def playing(self) -> bool:
        """Whether a tick would change anything."""
        return not self._lost and (self._report.playing or (self._other is not None and self._other.playing))

    @property
    def speed(self) -> float:
        """Simulated seconds per second, as asked for."""
        return self._report.speed

    @property
    def time_s(self) -> float:
        """Simulated time of the robot that is further on."""
        return max(self._report.time_s, self._other.time_s if self._other else 0.0)

    @property
    def waiting(self) -> bool:
        """Whether the first robot's process is being started again: commands must wait."""
        return self._lost

    def snapshot(self, number: int, real_time_factor: float) -> Snapshot:
        """The newest picture of all."""
        twin = None
        if self._wanted is not None or self._other is not None:
            comparison = self._comparison
            twin = TwinView(other=self._other_picture, divergence=comparison.divergence, marks=comparison.marks,
                            table=comparison.table())  # fmt: skip
        events = self._picture.events
        return replace(
            self._picture, number=number, real_time_factor=real_time_factor, playing=self.playing, twin=twin,
            run=self._picture.run + self._runs_before,
            events=(*reversed(self._notes), *events) if self._notes else events,
        )  # fmt: skip

    def close(self) -> None:
        """End all workers."""
        self._pool.close()

    def turn(
        self, commands: Sequence[cmd.Command], ticks: int, *, picture: bool, export_run: bool = False
    ) -> tuple[int, int]:
        """Obey, tick, take a picture: ticks made and unexpected errors. Nothing of that while ``waiting``.

        With ``export_run`` the first robot's run is in ``saved`` afterwards; None if its process was lost.
        """
        self.saved = None
        if self._lost:
            self._start_first_anew()
            return 0, 0
        commands = [command for command in commands if not self._starts_or_stops(command)]
        if self._wanted is not None:
            self._start_twin(self._wanted)
        commands, self._before_others = [*self._before_others, *commands], []
        if not (commands or ticks or picture or export_run or self._notes):
            return 0, 0
        notes, self._notes = tuple(self._notes), []
        if self._other is None:
            chosen = tuple(c for command in commands if (c := for_first(command)) is not None)
            request = Request(notes=notes, commands=chosen, ticks=ticks, picture=picture, export_run=export_run)
            return self._take(*self._pool.perform(request))
        over = self._report.ended, self._other.ended
        first, twin = split(commands, playing=self.playing, first_over=over == (True, False),
                            twin_over=over == (False, True))  # fmt: skip
        return self._take(*self._pool.perform(
            Request(notes=notes, commands=first, ticks=ticks, picture=picture, rows=True, export_run=export_run),
            Request(commands=twin, ticks=ticks, picture=picture, rows=True),
        ))  # fmt: skip

    def _take(self, reply: Reply | WorkerLostError, other: Reply | WorkerLostError | None = None) -> tuple[int, int]:
        """Take over what came of a request."""
        if isinstance(other, WorkerLostError):
            assert self._other is not None
            self._wanted, self._other, self._other_picture = self._other.spec, None, None
            self._pool.stop_twin()
            self._say(EventKind.ERROR, f"twin: {other}; it is started again, both begin anew")
        if isinstance(reply, WorkerLostError):
            self._lost = True
            self._pool.replace_first()
            self._say(EventKind.ERROR, f"{reply}; it is started again, paused at the start of the scenario")
            return 0, 1
        if reply.run != self._report.run:
            self._comparison = Comparison()
        self._report, self._picture, self.saved = reply, reply.picture or self._picture, reply.saved
        if not isinstance(other, Reply):
            return reply.ticks_done, reply.errors + (other is not None)
        self._other, self._other_picture = other, other.picture or self._other_picture
        self._compare(reply, other)
        self._keep_in_step(reply, other)
        return max(reply.ticks_done, other.ticks_done), reply.errors + other.errors

    def _starts_or_stops(self, command: cmd.Command) -> bool:
        if isinstance(command, cmd.StartTwin):
            spec = self._report.spec
            changes = {**spec.changes, **command.changes}
            self._wanted = replace(spec, controller=command.controller, changes=changes, undo=UndoStack())
        elif isinstance(command, cmd.StopTwin):
            self._end_twin(EventKind.RUN, "twin taken away")
        return isinstance(command, cmd.StartTwin | cmd.StopTwin)

    def _start_twin(self, wanted: RunSpec) -> None:
        """As soon as its process is there: the first robot's scenario for both, from its start."""

        def spec() -> RunSpec:  # a person may have gone on while the process started
            now = self._report.spec
            return replace(wanted, scenario=now.scenario, friction=now.friction, speed=now.speed)

        try:
            reply = self._pool.start_twin(spec)
        except SurefootError as error:
            self._wanted = None
            self._say(EventKind.ERROR, f"no twin: {error}")
            return
        if reply is not None:
            self._wanted, self._other, self._other_picture = None, reply, reply.picture
            self._before_others.append(cmd.Reset())
            self._say(
                EventKind.RUN, f"twin run: {self._report.spec.controller} and {wanted.controller}, both from the start"
            )

    def _end_twin(self, kind: EventKind, text: str) -> None:
        if self._other is not None or self._wanted is not None:
            self._say(kind, text)
        self._other = self._other_picture = self._wanted = None

    def _start_first_anew(self) -> None:
        spec = self._report.spec
        request = Request(start=spec, notes=tuple(self._notes), commands=(cmd.Pause(),), picture=True)
        reply = self._pool.start_first(request)
        if reply is not None:
            self._notes, self._lost, self._comparison = [], False, Comparison()
            self._runs_before += self._picture.run
            self._report, self._picture = reply, reply.picture or self._picture
            if self._other is not None:
                self._before_others.append(cmd.Reset(play=False))

    def _keep_in_step(self, reply: Reply, other: Reply) -> None:
        if reply.playing and other.playing:
            if abs(reply.time_s - other.time_s) > _IN_STEP_S:
                self._end_twin(
                    EventKind.ERROR, "twin taken away: out of step, a command could be obeyed by one of them only"
                )
        elif any(me.playing and not (they.playing or they.ended) for me, they in ((reply, other), (other, reply))):
            self._before_others.append(cmd.Pause())  # an error stopped one of them

    def _compare(self, reply: Reply, other: Reply) -> None:
        comparison, known = self._comparison, {(event.kind, event.text) for event in reply.new_events}
        told = [
            replace(event, text=f"twin: {event.text}") for event in other.new_events
            if event.kind.told_of_twin and (event.kind, event.text) not in known
        ]  # fmt: skip
        self._notes.extend(told)
        for event in (*reply.new_events, *told):
            comparison.note(event)
        before = comparison.divergence
        if reply.rows is not None and other.rows is not None:
            comparison.add(reply.rows, other.rows)
        found = comparison.divergence
        if found is not None and before is None:
            after = f", {found.time_s - found.after.time_s:.2f} s after: {found.after.text}" if found.after else ""
            self._say(
                EventKind.DIVERGENCE, f"the two CoMs are more than {1e3 * DIVERGED_M:g} mm apart{after}", found.time_s
            )

    def _say(self, kind: EventKind, text: str, time_s: float | None = None) -> None:
        self._notes.append(Event(self.time_s if time_s is None else time_s, kind, text))
