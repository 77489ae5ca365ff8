"""A robot that does not know everything: whoever decides reads nothing but readings, and all of it comes again."""

import numpy as np
import pytest

from surefoot.estimation.registry import TRUTH, estimators
from surefoot.robot.description import RobotState
from surefoot.robot.sensing import FootSensing
from surefoot.simulation.falls import ESTIMATOR_ERROR, NAN
from surefoot.simulation.plant import FootTruth
from surefoot.simulation.recorder import BELIEF_COLUMNS

ESTIMATORS = ["strapdown", *(name for name in estimators() if name != TRUTH)]
NOISY = {"sensors": {"preset": "lab", "seed": 3}, "estimator": {"kind": "strapdown"}}
WALK = {"support": "double", "reference": {"kind": "walk", "steps": 2, "start_s": 0.05}}
PUSHED = {"pushes": [{"link": "trunk", "impulse_ns": 3.0, "start_s": 0.05, "duration_s": 0.1}]}


def poison(plant) -> None:
    """From now on nobody gets a number of the true state or feet before the motors are told what to do.

    But for the signals that the sensors take; after that, falls and metrics get the feet.
    """
    sense, feet, signals, step = plant.sense, plant.feet, plant.signals, plant.step
    deciding = [True]

    def no_state():
        deciding[0] = True  # a tick begins
        state, sensing = sense()
        nothing = RobotState(np.full_like(state.q, np.nan), np.full_like(state.v, np.nan), state.time_s)
        return nothing, FootSensing(np.full_like(sensing.wrenches, np.nan))

    def no_feet():
        true = feet()
        if not deciding[0]:
            return true
        return tuple(FootTruth(*(np.full(shape, np.nan) for shape in (3, (3, 3), 3, 3))) for _ in true)

    def only_signals():
        deciding[0] = False
        found = signals()
        deciding[0] = True
        return found

    def decided(*args):
        deciding[0] = False
        return step(*args)

    plant.sense, plant.feet, plant.signals, plant.step = no_state, no_feet, only_signals, decided
    plant.com_now = lambda: (np.full(3, np.nan), np.full(3, np.nan))
    plant.position_com = lambda: np.full(3, np.nan)
    plant.link_rotation = lambda link: np.full((3, 3), np.nan)


@pytest.mark.parametrize("scenario", [PUSHED, WALK], ids=["pushed", "walk"])
@pytest.mark.parametrize(
    ("estimator", "controller"),
    [("strapdown", "soft-qp"), ("strapdown", "optimization"), *((name, "two-part") for name in ESTIMATORS)],
)
def test_nobody_who_decides_reads_anything_but_readings(simulate, scenario, estimator, controller):
    noisy = {**NOISY, "estimator": {"kind": estimator}}
    plain, poisoned = (simulate(controller, **noisy, **scenario) for _ in range(2))
    poison(poisoned.plant)
    poisoned.walk_watch = None  # a judge: it may have the truth, and cannot do without
    for _ in range(200):
        one, other = plain.tick(), poisoned.tick()
        assert one.applied.tobytes() == other.applied.tobytes()
        assert one.output.torques.any()
    assert plain.plant.data.qpos.tobytes() == poisoned.plant.data.qpos.tobytes()
    assert plain.fallen is None
    assert poisoned.fallen == NAN  # falls are judged by the truth: poisoned too


def test_with_the_truth_the_poison_is_noticed(simulate):
    simulation = simulate(**PUSHED)
    poison(simulation.plant)
    assert simulation.tick().fall_cause == NAN
    assert simulation.stopped


@pytest.mark.parametrize("estimator", ESTIMATORS)
@pytest.mark.parametrize("scenario", [PUSHED, WALK], ids=["pushed", "walk"])
def test_a_noisy_run_comes_again_from_a_checkpoint_and_from_its_start(simulate, scenario, estimator):
    def future(simulation, ticks):
        rows = []
        for _ in range(ticks):
            result = simulation.tick()
            rows.append((result.applied.tobytes(), result.belief.dcm_error.tobytes()))
        return rows

    tables = []
    for _ in range(2):
        sensors = {"preset": "robot", "seed": 3, "foot_period_s": 0.004, "foot_force_drift_n": 9.0}
        noisy = {"sensors": sensors, "estimator": {"kind": estimator}, "motors": {"preset": "robot"}}
        simulation = simulate(**noisy, **scenario)
        future(simulation, 90)
        kept = simulation.checkpoint()
        once = future(simulation, 100)
        tables.append(simulation.recorder.table())
        for _ in range(2):  # a checkpoint is not used up
            simulation.restore(kept)
            assert future(simulation, 100) == once
        assert simulation.recorder.table().tobytes() == tables[-1].tobytes()
    assert tables[0].tobytes() == tables[1].tobytes()


def test_the_record_has_the_truth_and_beside_it_the_belief(simulate):
    simulation, blind = simulate(**NOISY, **PUSHED), simulate(**PUSHED)
    for _ in range(200):
        simulation.tick()
    recorder = simulation.recorder
    assert recorder.columns == [*blind.recorder.columns, *BELIEF_COLUMNS]
    state, _ = simulation.plant.sense()
    height = recorder.column("pelvis_z_m")
    assert height[-1] == pytest.approx(state.q[2], abs=1e-3)
    com = np.array([recorder.column(f"com_{a}_m") for a in "xyz"])
    believed = np.array([recorder.column(f"believed_com_{a}_m") for a in "xyz"])
    position = np.array([recorder.column(f"position_error_{a}_m") for a in "xyz"])
    assert 1e-6 < np.abs(believed - com).max() < 0.02
    assert np.abs(believed - com - position).max() < 2e-3  # what is left: tilt and joints
    assert (recorder.column("dcm_sigma_x_m") > 0.0).all()


@pytest.mark.parametrize(("kind", "words"), [("failing", "no idea where I am"), ("gives-nan", "what is no number")])
def test_an_estimator_that_fails_switches_the_motors_off_and_is_named(simulate, kind, words):
    simulation = simulate(estimator={"kind": kind})
    results = [simulation.tick() for _ in range(60)]
    assert [result.fall_cause for result in results] == [None] * 50 + [ESTIMATOR_ERROR] * 10
    assert not results[50].applied.any()
    assert simulation.stopped
    assert simulation.fallen == ESTIMATOR_ERROR
    assert kind in simulation.error
    assert words in simulation.error
