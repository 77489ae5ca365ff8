"""The loop: one call is one millisecond. It never sleeps and reads no clock, so a run repeats to the bit."""

import traceback
from collections import deque
from collections.abc import Callable
from pathlib import Path

import numpy as np

from surefoot.control.interface import Controller, ControlOutput
from surefoot.control.output_check import output_fault
from surefoot.control.torque_blend import TorqueBlend
from surefoot.dynamics.model import DynamicsModel
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.errors import ControllerError, EstimatorError, one_line
from surefoot.gait.interface import Gait
from surefoot.gait.walk import Walk
from surefoot.momentum.zmp import capture_point, natural_frequency
from surefoot.record import record
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.simulation.belief import Belief, measure_belief
from surefoot.simulation.checkpoint import Checkpoint, copy_attributes, restore_attributes
from surefoot.simulation.external_forces import Pull, Push
from surefoot.simulation.falls import CONTROLLER_ERROR, ESTIMATOR_ERROR, NAN, LimitEvent, LimitWatch, fall_cause
from surefoot.simulation.measurement import BalanceMeasurement, measure_balance, measured_delta
from surefoot.simulation.physics import TIMESTEP_S
from surefoot.simulation.plant import Plant
from surefoot.simulation.recorder import Recorder
from surefoot.simulation.senses import Senses
from surefoot.simulation.walk_causes import WalkWatch
from surefoot.task.reference import Reference, TaskReference


@record
class TickResult:
    """What one tick saw, decided and caused.

    Attributes:
        terms: dynamics at the tick's true state; None in a tick that made no step: a NaN, or the controller failed.
        reference: wanted kappa.
        output: what the controller decided; None likewise.
        applied: torques the motors gave (15,) [N m].
        balance: measured ZMP, margin, forces.
        capture: capture point (2,) in world [m].
        limits: limits passed for the first time.
        fall_cause: named cause when this tick found the robot fallen.
        belief: what an estimator believed, and how wrong it was; None without one.
        position_com: the plant's own CoM (3,) in world [m]: with errors of the model not that of ``terms``, which are
            the nominal robot's; None in a tick that made no step.
    """

    terms: DynamicsTerms | None
    reference: TaskReference
    output: ControlOutput | None
    applied: np.ndarray
    balance: BalanceMeasurement
    capture: np.ndarray
    limits: tuple[LimitEvent, ...]
    fall_cause: str | None
    belief: Belief | None = None
    position_com: np.ndarray | None = None


class Simulation:
    """Robot, world and controller, stepped together at 1 kHz.

    With ``senses``, controller and gait get what an estimator believes, and falls, metrics and record have the truth.

    A controller may be someone else's code. Whatever it raises or gives, a tick comes back: one that cannot be made
    switches the motors off and is a fall, and another controller may go on from there.

    Args:
        robot: the robot; the controller's model is its nominal one.
        plant: the world, already reset.
        support: planned contacts.
        reference: wanted kappa over time.
        controller: decides the torques.
        recorder: written every tick.
        clock: optional timing probe, a function returning nanoseconds; none by default.
        controller_name: what people call the controller.
        gait: decides the wanted kappa tick by tick in place of the reference, and which feet are to stand.
        senses: sensors and estimator; without, controller and gait get the true state.

    Attributes:
        support: the feet that are to stand now.
        fallen, fall_time_s: cause and time of the first fall.
        fall_first: what went wrong first on the way to it, in a walk; else None.
        stopped: no step can be made any more, by a NaN or a controller that failed.
        error: what that controller, or the estimator, did, with its name.
    """

    def __init__(
        self,
        robot: RobotDescription,
        plant: Plant,
        support: Support,
        reference: Reference,
        controller: Controller,
        recorder: Recorder,
        *,
        clock: Callable[[], int] | None = None,
        controller_name: str = "",
        gait: Gait | None = None,
        senses: Senses | None = None,
    ):
        self.robot, self.plant, self.support, self.reference = robot, plant, support, reference
        self.controller, self.recorder = controller, recorder
        self.controller_name = controller_name
        self.gait, self.senses = gait, senses
        self.pushes: list[Push] = []
        self.pulls: dict[str, Pull] = {}  # by client
        self.watch = LimitWatch(robot)
        self.walk_watch = WalkWatch(robot, gait) if isinstance(gait, Walk) else None
        self.fallen: str | None = None
        self.fall_time_s: float | None = None
        self.fall_first: LimitEvent | None = None
        self.stopped = False
        self.error: str | None = None
        self.tick_ns: list[int] = []
        self._clock = clock
        self._own_com = senses is not None or plant.imperfections.model_error.any
        self._dynamics = DynamicsModel(robot)
        self._blend = TorqueBlend()
        self._torques: np.ndarray | None = None
        self._delayed: deque[np.ndarray] = deque()
        self._zero = np.zeros(len(robot.joints))

    @property
    def time_s(self) -> float:
        """Simulated time [s]."""
        return self.plant.time_s

    def active_pulls(self) -> tuple[Pull, ...]:
        """The pulls that are confirmed now."""
        return tuple(pull for pull in self.pulls.values() if self.time_s <= pull.until_s) if self.pulls else ()

    def switch(self, controller: Controller, name: str = "") -> None:
        """Hand over to another controller; its torques fade in over 50 ms. Where one failed, it goes on.

        Raises:
            ControllerError: it cannot take over; nothing has changed then.
        """
        try:
            controller.reset(self._torques)
        except (Exception, SystemExit) as error:
            called = name or type(controller).__name__
            raise ControllerError(called, f"cannot take over ({one_line(error)})") from error
        self._blend.start(self._torques)
        self.controller, self.controller_name = controller, name or self.controller_name
        if self.error is not None:
            self.error, self.stopped = None, False
            if self.fallen == CONTROLLER_ERROR:
                self.fallen = self.fall_time_s = self.fall_first = None

    def checkpoint(self) -> Checkpoint:
        """This instant, kept aside: put back, the same ticks follow to the bit.

        Raises:
            InvalidInput: the controller cannot be copied.
        """
        attributes = copy_attributes(self._changing(), self._unchanging())
        return Checkpoint(self.time_s, self.plant.memory.save_state(), attributes, self.recorder.written)

    def restore(self, checkpoint: Checkpoint) -> None:
        """Go back (or forward) to a checkpoint of this simulation."""
        restore_attributes(self._changing(), self._unchanging(), checkpoint.attributes)
        self.plant.memory.restore_state(checkpoint.world)
        self.recorder.rewind(checkpoint.rows)

    def tick(self) -> TickResult:
        """Advance by one millisecond."""
        plant = self.plant
        state, sensing = plant.sense()
        reference = self.reference.at(state.time_s)
        started, estimate, known = self._clock() if self._clock else 0, None, state
        if self.senses is not None:
            try:
                estimate = self.senses.estimate(plant)
            except EstimatorError as error:
                self.error = str(error)
                return self._stop(reference, ESTIMATOR_ERROR)
            known, sensing = estimate.state, estimate.sensing
        if not known.is_finite():
            return self._stop(reference, NAN)
        offset = self.senses.com_offset if self.senses is not None else None
        believed = terms = self._dynamics.evaluate(known) if offset is None else offset.evaluate(known, sensing)
        if self.gait is not None:
            reference = self.gait.tick(terms, sensing, reference)
            self.support = reference.support
        try:
            output = self.controller.tick(terms, reference, sensing)
            if self._clock:
                self.tick_ns.append(self._clock() - started)
            fault = output_fault(output, len(self._zero))
        except (Exception, SystemExit) as error:  # the run is to end in order, whatever went wrong there
            return self._stop_by_controller(terms, reference, f"{one_line(error)}{_place(error)}")
        if fault is not None:
            return self._stop_by_controller(terms, reference, fault)
        self._torques = torques = self._blend.apply(output.torques)
        if estimate is not None:
            terms = self._dynamics.evaluate(state)
        com, com_velocity = terms.position_com_in_world, terms.velocity_com_in_world
        if self._own_com:
            com, com_velocity = plant.com_now()
        applied = plant.step(self._delay(torques), self.pushes, self.active_pulls())
        if not plant.is_finite():
            return self._stop(reference, NAN)

        balance = measure_balance(plant.built, plant.feet(), self.support)
        carries = self.support if self.gait is None else Support.DOUBLE  # a walk's swing foot may land at any time
        cause = fall_cause(plant, state, balance, carries, ground_m=self._ground_m)
        limits = self.watch.update(state.time_s, state, output, applied, plant, balance, self._standing)
        weight = plant.mass_kg * terms.gravity
        omega = natural_frequency(float(com[2] - balance.origin[2]), terms.gravity)
        capture = capture_point(com, com_velocity, omega)
        if self.walk_watch is not None and self.fallen is None:
            self.walk_watch.update(terms, balance, plant.feet(), capture, omega)
        self._note_fall(cause, state.time_s)
        delta = measured_delta(balance, com, weight)
        belief = None
        if estimate is not None:
            belief = measure_belief(estimate, believed, state, plant.feet(), (com, com_velocity), omega)
        self.recorder.add(
            state,
            com,
            reference.position_com,
            com_velocity,
            capture,
            output,
            applied,
            balance,
            delta,
            plant.ground.slope,
            plant.acting,
            belief,
        )
        return TickResult(terms, reference, output, applied, balance, capture, limits, cause, belief, com)

    @property
    def _ground_m(self) -> float:
        """What the pelvis' height is counted from: a walk may lead up and down, its lower sole tells how far."""
        if self.gait is None:
            return 0.0
        soles = (
            float(foot.point_below(now.position_ankle, now.rotation)[2])
            for now, foot in zip(self.plant.feet(), self.plant.built.feet, strict=True)
        )
        return min(soles)

    @property
    def _standing(self) -> tuple[int, ...]:
        return self.support.stance if self.gait is None else self.gait.standing

    def _changing(self) -> tuple[object, ...]:
        return (self, self.plant, self.plant.stones, self.plant.ground, *((self.gait,) if self.gait else ()))

    def _unchanging(self) -> tuple[object, ...]:
        plant, robot = self.plant, self.robot
        plant_side = (plant.model, plant.data, plant.memory, plant.true_com, plant.built)
        senses = self.senses
        dynamics = (self._dynamics, *((senses.com_offset.dynamics,) if senses and senses.com_offset else ()))
        return (robot, robot.pinocchio_model, *plant_side, self.reference, self.recorder, *dynamics, self.tick_ns)

    def _delay(self, torques: np.ndarray) -> np.ndarray:
        ticks = round(self.plant.physics.control_delay_s / TIMESTEP_S)
        self._delayed.append(torques)
        while len(self._delayed) > ticks + 1:
            self._delayed.popleft()
        return self._delayed[0]

    def _note_fall(self, cause: str | None, time_s: float) -> None:
        if cause is not None and self.fallen is None:
            self.fallen, self.fall_time_s = cause, time_s
            if self.walk_watch is not None:
                self.fall_first = self.walk_watch.first_cause(cause, time_s)

    def _stop_by_controller(self, terms: DynamicsTerms, reference: TaskReference, what: str) -> TickResult:
        """The controller failed; with dynamics that are no numbers any more it could do nothing else."""
        if not terms.is_finite():
            return self._stop(reference, NAN)
        self.error = f"controller {self.controller_name or type(self.controller).__name__}: {what}"
        return self._stop(reference, CONTROLLER_ERROR)

    def _stop(self, reference: TaskReference, cause: str) -> TickResult:
        """What is no number never reaches the motors: they are switched off, and that is a fall."""
        self.stopped = True
        self._note_fall(cause, self.plant.time_s)
        nothing = np.full(2, np.nan)
        balance = BalanceMeasurement((0.0, 0.0), nothing, np.nan, np.full(3, np.nan), np.full(3, np.nan))
        return TickResult(None, reference, None, self._zero, balance, nothing, (), cause)


def _place(error: BaseException) -> str:
    """File and line where an error came from, for whoever wrote the controller."""
    frames = traceback.extract_tb(error.__traceback__)
    return f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""
