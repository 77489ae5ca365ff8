"""A run that can be changed while it goes on: simulation, controller, settings, and what was observed.

Exactly what a checkpoint holds. It knows no command, no past and no pace (those are ``playback``'s), and no clock
either, but for the probe that says how long a tick took; nothing depends on what it says.
"""

from collections.abc import Mapping
from dataclasses import replace
from time import perf_counter_ns
from typing import Any

from surefoot.control.registry import controller_named
from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.live.observation.delta_reference import bias_of, bias_view
from surefoot.dashboard.live.observation.event_log import EventLog, TickMonitor
from surefoot.dashboard.live.observation.observer import Observer
from surefoot.dashboard.live.rewind.history import HISTORY_TICKS
from surefoot.dashboard.live.undo import Tuning, UndoStack, tuning_view
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.messages.sensing import sensing_of
from surefoot.dashboard.messages.shown_robot import ShownRobot, shown_robot
from surefoot.dashboard.messages.snapshot import TuningView
from surefoot.dynamics.model import DynamicsModel
from surefoot.experiments.runs.events import in_order, scenario_events
from surefoot.experiments.runs.saved_run import SCRIPT, SavedRun, describe_run
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.changes import changes_of
from surefoot.experiments.scenario.references import build_reference, start_posture
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.simulation.falls import ESTIMATOR_ERROR
from surefoot.simulation.loop import TickResult

KEPT_TICKS = HISTORY_TICKS + 1_000  # in the recorder: more than can be gone back
AFTER_FALL_S = 1.5  # a fall goes on this long, so that one sees it


class LiveRun:
    """One simulation, the controller that drives it, and the settings that the user changed.

    Args:
        scenario: to start.
        controller: name in the registry.
        changes: settings that the user changed already.
        friction: None for the scenario's own.
        undo: changes that can be undone already.

    Attributes:
        warnings: what was found while the world was built.
        started_with: controller, and changes of its settings, that the run began with.
        scenario_changes: see ``changes_of``.
        sensing: sensors and estimator of the scenario.

    Raises:
        InvalidInput, PostureError, ControllerError: scenario or controller cannot be used.
    """

    def __init__(
        self,
        scenario: Scenario,
        controller: str,
        changes: Mapping[str, Any] | None = None,
        friction: float | None = None,
        undo: UndoStack | None = None,
    ) -> None:
        self.log = EventLog()
        self.undo = undo or UndoStack()
        self._robot: ShownRobot | None = None
        self._tuning_view: tuple[tuple[Any, ...], TuningView] | None = None
        self.start(scenario, friction, controller, changes or {})

    def start(self, scenario: Scenario, friction: float | None, controller: str, changes: Mapping[str, Any]) -> None:
        """Begin a scenario at its start. Raises InvalidInput, PostureError; nothing has changed then."""
        if friction is not None:
            scenario = replace(scenario, physics=replace(scenario.physics, friction=friction))
        changed = replace(scenario, controller={**scenario.controller, **changes})
        setup = build_simulation(changed, controller, rows=KEPT_TICKS, clock=perf_counter_ns)
        simulation = setup.simulation
        self.scenario, self.simulation, self.warnings = scenario, simulation, setup.warnings
        self.scenario_changes, self.sensing = changes_of(scenario), sensing_of(scenario)
        self.controller, self._changes = controller, dict(changes)
        self.started_with = controller, self._changes
        self.observer = Observer(simulation)
        self._monitor = TickMonitor(self.log)
        self._dynamics = DynamicsModel(simulation.robot)
        self._use(self.settings_of(controller, changes))

    @property
    def robot(self) -> ShownRobot:
        """Which robot it is of; the same object until it is another."""
        if self._robot is None or self._robot.key != self.scenario.robot:
            self._robot = shown_robot(self.scenario.robot, self.simulation.robot)
        return self._robot

    @property
    def friction(self) -> float:
        """Friction coefficient of ground and stones."""
        return self.simulation.plant.physics.friction

    @property
    def changes(self) -> Mapping[str, Any]:
        """Settings that the user changed; a change makes a new mapping."""
        return self._changes

    @property
    def tuning(self) -> Tuning:
        """Controller and settings as they are now."""
        return Tuning(self.controller, self._changes, self.settings)

    @property
    def tuning_view(self) -> TuningView:
        """What can be undone, and the settings without the user's changes; the same object until that changes."""
        of = self.undo, self.scenario, self.controller
        if self._tuning_view is None or any(a is not b for a, b in zip(of, self._tuning_view[0], strict=True)):
            self._tuning_view = of, tuning_view(self.undo, self.controller, self.settings_of)
        return self._tuning_view[1]

    @property
    def ended(self) -> bool:
        """Whether a fall has been shown to its end, or the controller failed."""
        simulation = self.simulation
        if simulation.stopped:
            return True
        return simulation.fall_time_s is not None and simulation.time_s >= simulation.fall_time_s + AFTER_FALL_S

    @property
    def controller_failed(self) -> bool:
        """Whether the run stands still by what its controller did, so that another one could go on from here."""
        return self.simulation.error is not None and self.simulation.fallen != ESTIMATOR_ERROR

    def settings_of(self, controller: str, changes: Mapping[str, Any]) -> ControllerSettings:
        """The settings that a controller has in this scenario, with these changes. Raises InvalidInput."""
        return controller_named(controller).settings({**self.scenario.controller, **changes})

    def advance(self) -> TickResult:
        """One tick."""
        result = self.simulation.tick()
        self.observer.look(result)
        self._monitor.observe(self.simulation, result)
        return result

    def hand_over(self, name: str, changes: dict[str, Any], drag_id: int = 0) -> None:
        """Let a controller with these changes of its settings drive, a step that can be undone.

        Raises:
            InvalidInput, PostureError, ControllerError: it cannot; nothing has changed then.
        """
        entry, before = controller_named(name), self.tuning
        settings = self.settings_of(name, changes)
        reference = build_reference(self.scenario, settings, self._dynamics)  # refuses an infeasible plan
        self.simulation.switch(entry.make(self.simulation.robot, settings), name)
        self.simulation.reference = reference
        self.controller, self._changes = name, changes
        self._use(settings)
        self.undo = self.undo.push(before, self.tuning, drag_id)

    def say(self, kind: EventKind, text: str, topic: str = "") -> None:
        """Write a line into the log."""
        self.log.add(self.simulation.time_s, kind, text, topic=topic)

    def save_state(self) -> tuple[Any, ...]:
        """All that decides the future, for ``restore_state``. Raises InvalidInput where it cannot be had."""
        tuned = self.controller, self._changes, self.settings, self.bias, self.undo
        observed = self.observer.save_state(), self._monitor.save_state(), self.log.save_state()
        return self.simulation.checkpoint(), tuned, observed

    def restore_state(self, state: tuple[Any, ...]) -> None:
        """Continue from a saved state."""
        checkpoint, tuned, (observed, noticed, lines) = state
        self.simulation.restore(checkpoint)
        self.controller, self._changes, self.settings, self.bias, self.undo = tuned
        self.observer.restore_state(observed)
        self._monitor.restore_state(noticed)
        self.log.restore_state(lines)

    def saved_run(self, script: Mapping[str, Any]) -> SavedRun:
        """The last seconds of this run as plain data; the script says what was done to it."""
        logged = tuple((event.time_s, str(event.kind), event.text) for event in reversed(self.log.events))
        events = in_order(scenario_events(self.scenario, self.simulation.time_s), logged)
        manifest = describe_run(self.simulation, self.scenario, self.controller, self.settings, events)
        manifest[SCRIPT] = script
        recorder = self.simulation.recorder
        return SavedRun(tuple(recorder.columns), recorder.table(), manifest)

    def _use(self, settings: ControllerSettings) -> None:
        """Remember the active settings, and say what a delta_P reference of theirs will do."""
        before, self.settings = getattr(self, "settings", None), settings
        self.bias = bias_view(self._dynamics, start_posture(self.scenario), settings)
        if before is not None and self.bias.outside and self.bias.reference_nm != bias_of(before):
            outside = ", ".join(self.bias.outside)
            self.say(EventKind.ERROR, f"delta_P reference outside its admissible interval: {outside}")
