"""The simulation live: obeys commands and ticks. No thread, so that a test can drive it.

No clock either, but for the probe that says how long a tick took; nothing depends on what it says.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from time import perf_counter_ns
from typing import Any

from surefoot.control.registry import controller_named
from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.live.handlers import playback as playing
from surefoot.dashboard.live.handlers import tuning as retune
from surefoot.dashboard.live.handlers.disturbances import hold_link, let_go, push_now, set_friction, tilt_ground
from surefoot.dashboard.live.handlers.stones import move_stone, place_stone, place_stone_at_sole, remove_stone
from surefoot.dashboard.live.observation.delta_reference import bias_of, bias_view
from surefoot.dashboard.live.observation.event_log import EventLog, TickMonitor
from surefoot.dashboard.live.observation.observer import Observer
from surefoot.dashboard.live.rewind.history import HISTORY_TICKS, History, Replayable
from surefoot.dashboard.live.undo import Tuning, UndoStack, tuning_view
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.messages.run_link import link_target, link_text, read_link
from surefoot.dashboard.messages.snapshot import TuningView
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import SurefootError
from surefoot.experiments.runs.saved_run import SavedRun, describe_run
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.references import build_reference, start_posture
from surefoot.experiments.scenario.scenario import Scenario, load_scenario
from surefoot.simulation.loop import TickResult

KEPT_TICKS = HISTORY_TICKS + 1_000  # in the recorder: more than can be gone back
AFTER_FALL_S = 1.5  # a fall goes on this long, so that one sees it


class LiveRun:
    """One simulation, the controller that drives it, and what a person changed.

    Args:
        scenario: shipped name or file, or one already loaded.
        controller: name in the registry.
        changes: settings that a person changed already.
        friction: None for the scenario's own.
        undo: changes that can be undone already.

    Raises:
        InvalidInput, PostureError: either cannot be used.
    """

    def __init__(
        self, scenario: str | Scenario, controller: str, changes: Mapping[str, Any] | None = None,
        friction: float | None = None, undo: UndoStack | None = None,
    ) -> None:  # fmt: skip
        self.log = EventLog()
        self.controller = controller
        self.playing = True
        self.speed = 1.0
        self.runs = 0
        self.undo = undo or UndoStack()
        self._tuned: tuple[tuple[Any, ...], TuningView] | None = None
        self._changes: dict[str, Any] = dict(changes or {})
        self._start(load_scenario(scenario) if isinstance(scenario, str) else scenario, friction)
        self._begin("scenario")
        self._obey: dict[type, Callable[[Any], None]] = {
            cmd.PlaceStone: self._place_stone,
            cmd.PlaceStoneAtSole: self._place_stone_at_sole, cmd.RemoveLastStone: self._remove_stone,
            cmd.ClearStones: self._clear_stones, cmd.PushNow: self._push, cmd.SetFriction: self._set_friction,
            cmd.Reset: self._reset, cmd.LoadScenario: self._load, cmd.MoveStone: self._move_stone,
            cmd.RemoveStone: self._remove_one, cmd.HoldLink: self._hold, cmd.LetGo: self._let_go,
            cmd.TiltGround: self._tilt, cmd.OpenLink: self._open,
            **{kind: partial(handler, self) for kind, handler in {**playing.OBEY, **retune.OBEY}.items()},
        }  # fmt: skip

    @property
    def friction(self) -> float:
        """Friction coefficient of ground and stones."""
        return self.simulation.plant.physics.friction

    @property
    def changes(self) -> Mapping[str, Any]:
        """Settings that a person changed; a change makes a new mapping."""
        return self._changes

    @property
    def tuning(self) -> TuningView:
        """What can be undone, and the settings without a person's changes; the same object until that changes."""
        of = self.undo, self.scenario, self.controller
        if self._tuned is None or any(a is not b for a, b in zip(of, self._tuned[0], strict=True)):
            self._tuned = of, tuning_view(self.undo, self.controller, self.settings_of)
        return self._tuned[1]

    @property
    def ended(self) -> bool:
        """Whether a fall has been shown to its end."""
        simulation = self.simulation
        if simulation.fallen == "nan":
            return True
        return simulation.fall_time_s is not None and simulation.time_s >= simulation.fall_time_s + AFTER_FALL_S

    def apply(self, command: cmd.Command) -> None:
        """Obey one command; one that cannot be obeyed becomes a line of the log and changes nothing."""
        driver = self.simulation.controller
        if self._try(command) and (self.simulation.controller is not driver or isinstance(command, cmd.WorldCommand)):
            self.history.obeyed(command)

    def tick(self) -> TickResult:
        """Advance by one millisecond; pauses when a fall has been shown."""
        result = self._advance()
        self.history.ticked()
        if self.ended and self.playing:
            self.playing = False
            self.say(EventKind.RUN, "paused after the fall: Reset starts again, the timeline goes back")
        return result

    def _try(self, command: cmd.Command) -> bool:
        try:
            self._obey[type(command)](command)
        except SurefootError as error:
            self.say(EventKind.ERROR, str(error))
            return False
        return True

    def saved_run(self) -> SavedRun:
        """The last seconds of this run as plain data."""
        events = tuple((event.time_s, event.kind, event.text) for event in reversed(self.log.events))
        manifest = describe_run(self.simulation, self.scenario, self.controller, self.settings, events)
        recorder = self.simulation.recorder
        return SavedRun(tuple(recorder.columns), recorder.table(), manifest)

    def _advance(self) -> TickResult:
        result = self.simulation.tick()
        self.observer.look(result)
        self._watch.observe(self.simulation, result)
        return result

    def _begin(self, what: str) -> None:
        """Say what runs, and begin a history with that."""
        self.say(EventKind.RUN, f"{what} {self.scenario.name}, controller {self.controller}")
        replayable = Replayable(self._save_state, self._restore_state, self._advance, self._try)
        self.history = History(replayable, self.log, repeat=self.history.repeat if self.runs > 1 else True)

    def _save_state(self) -> tuple[Any, ...]:
        mine = self.controller, self._changes, self.settings, self.bias, self.undo
        return (
            self.simulation.checkpoint(),
            mine,
            self.observer.save_state(),
            self._watch.save_state(),
            self.log.save_state(),
        )

    def _restore_state(self, kept: tuple[Any, ...]) -> None:
        checkpoint, mine, seen, noticed, lines = kept
        self.simulation.restore(checkpoint)
        self.controller, self._changes, self.settings, self.bias, self.undo = mine
        self.observer.restore_state(seen)
        self._watch.restore_state(noticed)
        self.log.restore_state(lines)

    def _start(self, scenario: Scenario, friction: float | None) -> None:
        if friction is not None:
            scenario = replace(scenario, physics=replace(scenario.physics, friction=friction))
        changed = replace(scenario, controller={**scenario.controller, **self._changes})
        simulation = build_simulation(changed, self.controller, rows=KEPT_TICKS, clock=perf_counter_ns).simulation
        self.scenario, self.simulation = scenario, simulation  # only now: a failure above changes nothing
        self.observer = Observer(simulation)
        self._watch = TickMonitor(self.log)
        self._dynamics = DynamicsModel(simulation.robot)
        self._take_over(self.settings_of(self.controller, self._changes))
        self.runs += 1

    def hand_over(self, name: str, changes: dict[str, Any], drag_id: int = 0) -> None:
        """Let a controller with these changes of its settings drive, a step that can be undone.

        Raises:
            InvalidInput, PostureError: it cannot; nothing has changed then.
        """
        entry, before = controller_named(name), self._now()
        settings = self.settings_of(name, changes)
        reference = build_reference(self.scenario, settings, self._dynamics)  # refuses an infeasible plan
        self.simulation.switch(entry.build(self.simulation.robot, settings))
        self.simulation.reference = reference
        self.controller, self._changes = name, changes
        self._take_over(settings)
        self.undo = self.undo.push(before, self._now(), drag_id)

    def _now(self) -> Tuning:
        return Tuning(self.controller, self._changes, self.settings)

    def _take_over(self, settings: ControllerSettings) -> None:
        """Remember the active settings, and say what a delta_P reference of theirs will do."""
        before, self.settings = getattr(self, "settings", None), settings
        self.bias = bias_view(self._dynamics, start_posture(self.scenario), settings)
        if before is not None and self.bias.outside and self.bias.reference_nm != bias_of(before):
            self.say(
                EventKind.ERROR, f"delta_P reference outside its admissible interval: {', '.join(self.bias.outside)}"
            )

    def settings_of(self, controller: str, changes: Mapping[str, Any]) -> ControllerSettings:
        """The settings that a controller has in this scenario, with these changes. Raises InvalidInput."""
        return controller_named(controller).settings({**self.scenario.controller, **changes})

    def _place_stone(self, command: cmd.PlaceStone) -> None:
        self.say(EventKind.STONE, place_stone(self.simulation, command))

    def _place_stone_at_sole(self, command: cmd.PlaceStoneAtSole) -> None:
        self.say(EventKind.STONE, place_stone_at_sole(self.simulation, command))

    def _remove_stone(self, command: cmd.RemoveLastStone) -> None:
        removed = self.simulation.plant.stones.remove_last()
        self.say(EventKind.STONE, "newest stone removed" if removed else "there is no stone")

    def _clear_stones(self, command: cmd.ClearStones) -> None:
        self.simulation.plant.stones.clear()
        self.say(EventKind.STONE, "all stones removed")

    def _push(self, command: cmd.PushNow) -> None:
        self.say(EventKind.PUSH, push_now(self.simulation, command))

    def _move_stone(self, command: cmd.MoveStone) -> None:
        self.say(EventKind.STONE, move_stone(self.simulation, command), topic=f"move {command.number}")

    def _remove_one(self, command: cmd.RemoveStone) -> None:
        self.say(EventKind.STONE, remove_stone(self.simulation, command.number))

    def _hold(self, command: cmd.HoldLink) -> None:
        if line := hold_link(self.simulation, command):
            self.say(EventKind.PUSH, line)

    def _let_go(self, command: cmd.LetGo) -> None:
        if line := let_go(self.simulation, command.who):
            self.say(EventKind.PUSH, line)

    def _tilt(self, command: cmd.TiltGround) -> None:
        self.say(EventKind.RUN, tilt_ground(self.simulation, command))

    def _set_friction(self, command: cmd.SetFriction) -> None:
        self.say(EventKind.RUN, set_friction(self.simulation, command.friction), topic="friction")

    def _reset(self, command: cmd.Reset) -> None:
        self._start(self.scenario, self.friction)
        self.playing = command.play
        self._begin("reset: scenario")

    def _load(self, command: cmd.LoadScenario) -> None:
        self._start(load_scenario(command.name), None)
        self.playing = True
        self._begin("scenario")

    def _open(self, command: cmd.OpenLink) -> None:
        before, tuned = (self.controller, self._changes), self._now()
        try:
            link = read_link(command.query)
            scenario, changes = link_target(link)
            self.controller, self._changes = link.controller, changes
            self._start(scenario, None)
        except SurefootError:
            self.controller, self._changes = before
            raise
        self.undo = self.undo.push(tuned, self._now())
        self.playing = True
        self.say(EventKind.RUN, f"opened by a link: {link_text(link)}")
        self._begin("scenario")

    def say(self, kind: EventKind, text: str, topic: str = "") -> None:
        """Write a line into the log."""
        self.log.add(self.simulation.time_s, kind, text, topic=topic)
