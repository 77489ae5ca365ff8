"""One robot, or two in step: the same commands at the same tick, the same number of ticks, one snapshot of all.

Which command of a twin run is for whom, its audience says; most are for both: disturbances, pace, reset.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

from surefoot.dashboard.engine.lane import Lane
from surefoot.dashboard.engine.twin_comparison import Comparison
from surefoot.dashboard.engine.worker import Reply, Request, Worker, WorkerLostError
from surefoot.dashboard.live.undo import UndoStack
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.command_base import Audience, Command, TwinCommand
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.snapshot import DIVERGED_M, Snapshot, TwinView
from surefoot.errors import SurefootError
from surefoot.experiments.runs.saved_run import SavedRun

_IN_STEP_S = 1e-6


def for_first(command: Command) -> Command | None:
    """What the first robot is asked to do by a command; None for nothing."""
    return None if command.audience is Audience.TWIN else command


def for_twin(command: Command) -> Command | None:
    """What the twin is asked to do by it; None for nothing."""
    if isinstance(command, TwinCommand):
        return command.for_twin()
    return None if command.audience is Audience.FIRST else command


def split(
    commands: Iterable[Command], *, playing: bool, first_over: bool, twin_over: bool
) -> tuple[tuple[Command, ...], tuple[Command, ...]]:
    """Commands for the first robot and for its twin.

    Args:
        commands: in order.
        playing: whether either of them plays.
        first_over: the first has been shown to its end and stays where it fell while the twin goes on.
        twin_over: likewise the other way round.
    """
    first, twin = [], []
    for given in commands:
        command = given
        if isinstance(command, cmd.TogglePlay):  # one by one they would get out of step
            command = cmd.Pause() if playing else cmd.Play()
        for chosen, route, over in ((first, for_first, first_over), (twin, for_twin, twin_over)):
            asked = route(command)
            if asked is not None and not (over and isinstance(asked, cmd.Play)):
                chosen.append(asked)
    return tuple(first), tuple(twin)


class Turn(NamedTuple):
    """Result of a turn.

    Attributes:
        ticks: made.
        errors: unexpected exceptions, and workers lost.
        saved: the first robot's run, when asked for; None if its process was lost.
    """

    ticks: int = 0
    errors: int = 0
    saved: SavedRun | None = None


class Coordinator:
    """Gives requests to the lanes' workers and puts their replies together.

    Args:
        first: worker that has a run.
        spawn: makes another worker, one without a run; OSError when it cannot.

    Attributes:
        lanes: the first robot's and the twin's.

    Raises:
        WorkerLostError: ``first`` is gone.
    """

    def __init__(self, first: Worker, spawn: Callable[[], Worker]) -> None:
        self.lanes = (Lane(spawn, first), Lane(spawn))
        self._first, self._twin = self.lanes
        first.begin(Request(snapshot=True))
        self._first.take(first.finish())
        self._comparison = Comparison()
        self._notes: list[Event] = []
        self._before_others: list[Command] = []
        self._runs_before = 0

    @property
    def playing(self) -> bool:
        """Whether a tick would change anything."""
        return self._first.running and any(lane.running and lane.reply.playing for lane in self.lanes if lane.reply)

    @property
    def speed(self) -> float:
        """Simulated seconds per second, as asked for."""
        return self._now.speed

    @property
    def time_s(self) -> float:
        """Simulated time of the robot that is further on."""
        return max(lane.reply.time_s for lane in self.lanes if lane.reply)

    @property
    def robots(self) -> int:
        """How many are simulated at the same time."""
        return 1 + self._twin.running

    @property
    def waiting(self) -> bool:
        """Whether the first robot's process is restarted: commands must wait."""
        return self._first.starting

    @property
    def _now(self) -> Reply:
        """The first robot's last reply."""
        assert self._first.reply is not None
        return self._first.reply

    def snapshot(self, number: int, real_time_factor: float) -> Snapshot:
        """The newest snapshot of all."""
        first, twin = self._first.snapshot, None
        assert first is not None
        if self._twin.starting or self._twin.running:
            comparison = self._comparison
            twin = TwinView(
                other=self._twin.snapshot,
                divergence=comparison.divergence,
                marks=comparison.marks,
                table=comparison.table(),
            )
        return replace(
            first,
            number=number,
            real_time_factor=real_time_factor,
            playing=self.playing,
            twin=twin,
            run=first.run + self._runs_before,
            events=(*reversed(self._notes), *first.events) if self._notes else first.events,
        )

    def close(self) -> None:
        """End all workers."""
        for lane in self.lanes:
            lane.close()

    def turn(self, commands: Sequence[Command], ticks: int, *, snapshot: bool, export_run: bool = False) -> Turn:
        """Obey, tick, take a snapshot. Nothing of that while ``waiting``."""
        if self._first.starting:
            self._try_restart_first()
            return Turn()
        commands = [command for command in commands if not self._starts_or_stops(command)]
        if self._twin.starting:
            self._try_start_twin()
        commands, self._before_others = [*self._before_others, *commands], []
        if not (commands or ticks or snapshot or export_run or self._notes):
            return Turn()
        notes, self._notes = tuple(self._notes), []
        if not self._twin.running:
            chosen = tuple(c for command in commands if (c := for_first(command)) is not None)
            request = Request(notes=notes, commands=chosen, ticks=ticks, snapshot=snapshot, export_run=export_run)
            return self._take(self._first.exchange(request)())
        assert self._twin.reply is not None
        over = self._now.ended, self._twin.reply.ended
        first, twin = split(
            commands, playing=self.playing, first_over=over == (True, False), twin_over=over == (False, True)
        )
        requests = (
            Request(notes=notes, commands=first, ticks=ticks, snapshot=snapshot, rows=True, export_run=export_run),
            Request(commands=twin, ticks=ticks, snapshot=snapshot, rows=True),
        )
        results = [lane.exchange(request) for lane, request in zip(self.lanes, requests, strict=True)]
        return self._take(*[finish() for finish in results])

    def _take(self, reply: Reply | WorkerLostError, other: Reply | WorkerLostError | None = None) -> Turn:
        """Take in the results of a turn."""
        if isinstance(other, WorkerLostError):
            self._twin.restart()
            self._twin.reply = self._twin.snapshot = None
            self._say(EventKind.ERROR, f"twin: {other}; it is started again, both begin anew")
        if isinstance(reply, WorkerLostError):
            self._first.restart()
            self._say(EventKind.ERROR, f"{reply}; it is started again, paused at the start of the scenario")
            return Turn(errors=1)
        if reply.run != self._now.run:
            self._comparison = Comparison()
        self._first.take(reply)
        if not isinstance(other, Reply):
            return Turn(reply.ticks_done, reply.errors + (other is not None), reply.saved)
        self._twin.take(other)
        self._compare(reply, other)
        self._keep_in_step(reply, other)
        return Turn(max(reply.ticks_done, other.ticks_done), reply.errors + other.errors, reply.saved)

    def _starts_or_stops(self, command: Command) -> bool:
        if isinstance(command, cmd.StartTwin):
            spec = self._now.spec
            changes = {**spec.changes, **command.changes}
            self._twin.want(replace(spec, controller=command.controller, changes=changes, undo=UndoStack()))
        elif isinstance(command, cmd.StopTwin):
            self._end_twin(EventKind.RUN, "twin taken away")
        return isinstance(command, cmd.StartTwin | cmd.StopTwin)

    def _try_start_twin(self) -> None:
        """As soon as its process is there: the first robot's scenario for both, from its start."""
        now, wanted = self._now.spec, self._twin.spec
        assert wanted is not None
        # the user may have gone on while the process started
        spec = replace(wanted, scenario=now.scenario, friction=now.friction, speed=now.speed)
        try:
            reply = self._twin.try_start(Request(start=spec, snapshot=True))
        except SurefootError as error:
            self._twin.give_up()
            self._say(EventKind.ERROR, f"no twin: {error}")
            return
        if reply is not None:
            self._before_others.append(cmd.Reset())
            self._say(EventKind.RUN, f"twin run: {now.controller} and {wanted.controller}, both from the start")

    def _end_twin(self, kind: EventKind, text: str) -> None:
        if self._twin.running or self._twin.starting:
            self._say(kind, text)
        self._twin.stop()

    def _try_restart_first(self) -> None:
        assert self._first.snapshot is not None
        runs_before = self._first.snapshot.run
        request = Request(start=self._first.spec, notes=tuple(self._notes), commands=(cmd.Pause(),), snapshot=True)
        try:
            reply = self._first.try_start(request)
        except WorkerLostError:  # twice: no process for this one
            reply = self._first.start_inline(request)
        if reply is not None:
            self._notes, self._comparison = [], Comparison()
            self._runs_before += runs_before
            if self._twin.running:
                self._before_others.append(cmd.Reset(play=False))

    def _keep_in_step(self, reply: Reply, other: Reply) -> None:
        if reply.playing and other.playing:
            if abs(reply.time_s - other.time_s) > _IN_STEP_S:
                text = "twin taken away: out of step, a command could be obeyed by one of them only"
                self._end_twin(EventKind.ERROR, text)
        elif any(me.playing and not (they.playing or they.ended) for me, they in ((reply, other), (other, reply))):
            self._before_others.append(cmd.Pause())  # an error stopped one of them

    def _compare(self, reply: Reply, other: Reply) -> None:
        comparison, known = self._comparison, {(event.kind, event.text) for event in reply.new_events}
        twin_events = [
            replace(event, text=f"twin: {event.text}")
            for event in other.new_events
            if event.kind.logged_of_twin and (event.kind, event.text) not in known
        ]
        self._notes.extend(twin_events)
        for event in (*reply.new_events, *twin_events):
            comparison.note(event)
        before = comparison.divergence
        if reply.rows is not None and other.rows is not None:
            comparison.add(reply.rows, other.rows)
        found = comparison.divergence
        if found is not None and before is None:
            after = f", {found.time_s - found.after.time_s:.2f} s after: {found.after.text}" if found.after else ""
            text = f"the two CoMs are more than {1e3 * DIVERGED_M:g} mm apart{after}"
            self._say(EventKind.DIVERGENCE, text, found.time_s)

    def _say(self, kind: EventKind, text: str, time_s: float | None = None) -> None:
        self._notes.append(Event(self.time_s if time_s is None else time_s, kind, text))
