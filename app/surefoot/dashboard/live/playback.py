"""A live run with its past and its pace: obeys commands, ticks, seeks. No thread, so that a test can drive it."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from surefoot.dashboard.live.handlers import disturbances, stones, tuning, walking
from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.rewind.history import History, Replayable, tick_of
from surefoot.dashboard.live.rewind.run_script import run_script
from surefoot.dashboard.live.undo import UndoStack
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.command_base import Command, WorldCommand
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.messages.run_link import changes_text, link_target, link_text, read_link
from surefoot.dashboard.messages.sensing import PERFECT_SENSING, sensing_of, with_sensing
from surefoot.dashboard.messages.snapshot import LinkOutcome, Snapshot
from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.experiments.scenario.robots import is_robot_file
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, shipped_scenarios
from surefoot.robot.description import available_robots
from surefoot.simulation.loop import TickResult

_LINKS_KEPT = 20
HANDLERS = {**stones.HANDLERS, **disturbances.HANDLERS, **walking.HANDLERS, **tuning.HANDLERS}


class Playback:
    """Plays a live run.

    Args:
        scenario: shipped name or file, or one already loaded.
        controller, changes, friction, undo: see ``LiveRun``.
        robot_file: that of a robot of somebody's own which may be chosen besides those there are; None: the scenario's.

    Attributes:
        live: the run.
        history: its last 30 s.
        playing: whether ticks are wanted.
        speed: simulated seconds per second.
        runs: starts of a scenario so far.
        links: what became of the last links.
        robot_file: see there; None: none.

    Raises:
        InvalidInput, PostureError: scenario or controller cannot be used.
    """

    def __init__(
        self,
        scenario: str | Scenario,
        controller: str,
        changes: Mapping[str, Any] | None = None,
        friction: float | None = None,
        undo: UndoStack | None = None,
        robot_file: str | None = None,
    ) -> None:
        loaded = load_scenario(scenario) if isinstance(scenario, str) else scenario
        self.live = LiveRun(loaded, controller, changes, friction, undo)
        self.robot_file = robot_file or (loaded.robot if is_robot_file(loaded.robot) else None)
        self.playing, self.speed, self.runs = True, 1.0, 0
        self.links: tuple[LinkOutcome, ...] = ()
        self._begin_history("scenario", repeat=True)
        self._own: dict[type, Callable[[Any], None]] = {
            cmd.SetSpeed: self._set_speed,
            cmd.Play: self._play,
            cmd.Pause: self._pause,
            cmd.TogglePlay: self._toggle,
            cmd.Step: self._step,
            cmd.Seek: self._seek,
            cmd.GoLive: self._go_live,
            cmd.Reset: self._reset,
            cmd.RepeatDisturbances: self._repeat,
            cmd.LoadScenario: self._load,
            cmd.ChooseRobot: self._choose_robot,
            cmd.ChangeSensing: self._change_sensing,
            cmd.OpenLink: self._open_link,
            cmd.Refused: self._refused,
        }

    def apply(self, command: Command) -> None:
        """Obey one command; one that cannot be obeyed becomes a line of the log and changes nothing."""
        driver = self.live.simulation.controller
        obeyed = self._try(command)
        if obeyed and (self.live.simulation.controller is not driver or isinstance(command, WorldCommand)):
            self.history.obeyed(command, (self.live.controller, self.live.changes))

    def tick(self) -> TickResult:
        """Advance by one millisecond; pauses when a fall has been shown, or the controller failed."""
        result = self.live.advance()
        if not self.live.simulation.stopped:  # else no time has gone by, and what comes next has the same number
            self.history.ticked()
        if self.live.ended and self.playing:
            self.playing = False
            failed = self.live.controller_failed
            others = "another controller or setting and Play go on" if failed else "the timeline goes back"
            self.live.say(EventKind.RUN, f"paused after the fall: Reset starts again, {others}")
        return result

    def saved_run(self) -> SavedRun:
        """The last seconds of the run as plain data, with all that was done to it since its start."""
        live = self.live
        return live.saved_run(run_script(*live.started_with, self.history.tick, self.history.journal))

    def snapshot(self) -> Snapshot:
        """The run as it is now; number, real-time factor and twin are filled in by the coordinator."""
        live, observer = self.live, self.live.observer
        return Snapshot(
            number=0,
            run=self.runs,
            time_s=live.simulation.time_s,
            playing=self.playing,
            speed=self.speed,
            real_time_factor=0.0,
            scenario=live.scenario.name,
            robot=live.robot,
            controller=live.controller,
            support=str(live.scenario.support),
            settings=live.settings,
            friction=live.friction,
            bias=live.bias,
            geometry=observer.geometry(),
            balance=observer.balance_status(ended=live.ended),
            traces=observer.traces(),
            limits=observer.limits,
            events=live.log.events,
            timeline=self.history.view(),
            tuning=live.tuning_view,
            headroom=observer.headroom(),
            links=self.links,
            terrain=live.simulation.plant.terrain,
            walk=live.simulation.gait.progress if live.simulation.gait is not None else None,
            changes=live.scenario_changes,
            sensing=live.sensing,
        )

    def _try(self, command: Command) -> bool:
        try:
            if own := self._own.get(type(command)):
                own(command)
            elif line := HANDLERS[type(command)](self.live, command):
                self.live.say(*line)
        except SurefootError as error:
            self.live.say(EventKind.ERROR, str(error))
            return False
        return True

    def _begin_history(self, what: str, *, repeat: bool) -> None:
        """Say what runs, and begin a history with that."""
        live = self.live
        self.runs += 1
        live.say(EventKind.RUN, f"{what} {live.scenario.name}, controller {live.controller}")
        for warning in live.warnings:
            live.say(EventKind.RUN, f"warning: {warning}")
        replayable = Replayable(live.save_state, live.restore_state, live.advance, self._try)
        self.history = History(replayable, live.log, repeat=repeat)

    def _refused(self, command: cmd.Refused) -> None:
        self.live.say(EventKind.ERROR, command.text)

    def _set_speed(self, command: cmd.SetSpeed) -> None:
        if not cmd.SLOWEST <= command.speed <= cmd.FASTEST:
            raise InvalidInput("speed", command.speed, "out of range", [f"{cmd.SLOWEST} to {cmd.FASTEST}"])
        self.speed = float(command.speed)

    def _play(self, command: Command) -> None:
        if self.live.ended:
            fallen = self.live.simulation.fallen
            others = ["another controller"] if self.live.controller_failed else []
            raise InvalidInput(
                "play", fallen, f"{self.live.robot.title} has fallen", ["Reset", "go back in the timeline", *others]
            )
        self.playing = True

    def _pause(self, command: cmd.Pause) -> None:
        self.playing = False

    def _toggle(self, command: cmd.TogglePlay) -> None:
        if self.playing:
            self.playing = False
        else:
            self._play(command)

    def _step(self, command: cmd.Step) -> None:
        """Some ticks ahead, or back as far as the past is kept."""
        history = self.history
        if command.ticks < 0:
            history.seek(max(history.tick + command.ticks, history.oldest))
        self.playing = False
        for _ in range(command.ahead):
            if not self.live.ended:
                self.tick()

    def _seek(self, command: cmd.Seek) -> None:
        self.history.seek(tick_of(command.time_s))
        self.playing = False

    def _go_live(self, command: cmd.GoLive) -> None:
        self.history.seek(self.history.newest)
        self.playing = not self.live.ended

    def _repeat(self, command: cmd.RepeatDisturbances) -> None:
        self.history.repeat = bool(command.repeat)

    def _reset(self, command: cmd.Reset) -> None:
        live = self.live
        live.start(live.scenario, live.friction, live.controller, live.changes)
        self.playing = command.play
        self._begin_history("reset: scenario", repeat=self.history.repeat)

    def _load(self, command: cmd.LoadScenario) -> None:
        changes = {**command.changes, "robot": self.live.scenario.robot}  # last: a page names no files
        scenario = load_scenario(command.name, changes, robot_files=True)
        if sensing_of(scenario) == PERFECT_SENSING:
            scenario = with_sensing(scenario, self.live.sensing)
        self._start(scenario)
        if command.changes:
            self.live.say(EventKind.RUN, f"started with {changes_text(command.changes)}")
        self._begin_history("scenario", repeat=self.history.repeat)

    def _choose_robot(self, command: cmd.ChooseRobot) -> None:
        choices = [*available_robots(), *([self.robot_file] if self.robot_file else [])]
        if command.robot not in choices:
            raise InvalidInput("robot", command.robot, "no such robot", choices)
        self._start(self._scenario_for(command.robot))
        self.live.say(EventKind.RUN, f"robot {self.live.robot.title}")
        self._begin_history("scenario", repeat=self.history.repeat)

    def _scenario_for(self, robot: str) -> Scenario:
        """What runs now, for another robot: a scenario of ours with its sizes in proportion, another one as it is."""
        live = self.live
        scenario, changes = live.scenario, live.scenario_changes
        if changes is None and is_robot_file(scenario.robot):  # no link can say it, but its file can be read again
            changes = {}
        if changes is None or scenario.name not in shipped_scenarios():
            return replace(scenario, robot=robot)
        found = load_scenario(scenario.name, {**changes, "robot": robot}, robot_files=True)
        return with_sensing(found, live.sensing)

    def _change_sensing(self, command: cmd.ChangeSensing) -> None:
        live = self.live
        sensing = live.sensing.changed(command)
        if sensing == live.sensing:
            return
        self._start(with_sensing(live.scenario, sensing), live.friction)
        live.say(EventKind.RUN, f"started again with {sensing.in_words()}")
        self._begin_history("scenario", repeat=self.history.repeat)

    def _start(self, scenario: Scenario, friction: float | None = None) -> None:
        self.live.start(scenario, friction, self.live.controller, self.live.changes)
        self.playing = True

    def _open_link(self, command: cmd.OpenLink) -> None:
        refused: str | None = "an internal error: the log on the terminal has more"
        try:
            self._start_link(command.query)
            refused = None
        except SurefootError as error:
            refused = str(error)
            raise
        finally:
            self.links = (*self.links, LinkOutcome(ticket=command.ticket, refused=refused))[-_LINKS_KEPT:]

    def _start_link(self, query: str) -> None:
        live, before = self.live, self.live.tuning
        link = read_link(query)
        scenario, changes = link_target(link, live.scenario.robot)
        live.start(scenario, None, link.controller, changes)
        live.undo = live.undo.push(before, live.tuning)
        self.playing = True
        live.say(EventKind.RUN, f"opened by a link: {link_text(link)}")
        self._begin_history("scenario", repeat=self.history.repeat)
