"""A controller that fails ends the run as a fall with its name; nothing reaches the motors, another one may go on."""

import re
from dataclasses import replace

import numpy as np
import pytest

from surefoot.control.interface import Status
from surefoot.control.output_check import output_fault
from surefoot.errors import ControllerError

TICKS = 5


class Spoilt:
    """The controller of a simulation, until it is told to fail: what it decided is then changed by a function."""

    def __init__(self, inner, spoil):
        self._inner, self._spoil, self.ticks = inner, spoil, 0

    def reset(self, last_torques=None):
        self._inner.reset(last_torques)

    def tick(self, terms, reference, sensing):
        output = self._inner.tick(terms, reference, sensing)
        self.ticks += 1
        return output if self.ticks <= TICKS else self._spoil(output)


def explode(output):
    raise ZeroDivisionError("oh")


def with_nan(values):
    spoilt = values.copy()
    spoilt[0] = np.nan
    return spoilt


SPOILT = {  # what is done to the output -> what is said of it
    "raises": (explode, r"ZeroDivisionError: oh \(test_controller_errors.py, line \d+\)"),
    "leaves": (lambda o: (_ for _ in ()).throw(SystemExit(1)), "SystemExit: 1"),
    "nothing": (lambda o: None, "a NoneType, not a ControlOutput"),
    "torques alone": (lambda o: o.torques, "an? ndarray, not a ControlOutput"),
    "too few": (lambda o: replace(o, torques=o.torques[:14]), r"torques of shape \(14,\)"),
    "a column": (lambda o: replace(o, torques=o.torques[:, None]), r"torques of shape \(15, 1\)"),
    "a list": (lambda o: replace(o, torques=o.torques.tolist()), "torques as a list"),
    "texts": (lambda o: replace(o, torques=o.torques.astype(str)), "torques of shape"),
    "complex": (lambda o: replace(o, torques=o.torques + 0j), "type complex128"),
    "a NaN": (lambda o: replace(o, torques=with_nan(o.torques)), "nan N m"),
    "an infinity": (lambda o: replace(o, torques=o.torques - np.inf), "-inf N m"),
    "no ZMP": (lambda o: replace(o, zmp_commanded_in_world=None), "zmp_commanded_in_world as a NoneType"),
    "a ZMP in space": (lambda o: replace(o, zmp_wanted_in_world=np.zeros(3)), r"zmp_wanted_in_world of shape \(3,\)"),
    "half a delta": (lambda o: replace(o, delta_commanded=np.zeros(2)), "delta_commanded of shape"),
    "a status of its own": (lambda o: replace(o, status="fine"), "status 'fine'"),
    "flags": (lambda o: replace(o, infeasible=np.zeros(2, bool)), "infeasible as a ndarray"),
}


@pytest.fixture
def spoilt(simulate):
    def build(spoil, **scenario):
        simulation = simulate(**scenario)
        simulation.controller = Spoilt(simulation.controller, spoil)
        for _ in range(TICKS):
            assert simulation.tick().fall_cause is None
        return simulation

    return build


@pytest.mark.parametrize(("spoil", "reason"), SPOILT.values(), ids=SPOILT)
def test_the_run_ends_as_a_fall_that_names_the_controller(spoilt, spoil, reason):
    simulation = spoilt(spoil)
    data = simulation.plant.data
    before = data.qpos.tobytes(), data.time, data.ctrl.tobytes(), len(simulation.recorder)
    tick = simulation.tick()
    assert (tick.fall_cause, simulation.fallen, simulation.stopped) == ("controller_error", "controller_error", True)
    assert simulation.fall_time_s == pytest.approx(TICKS * 1e-3)
    assert not tick.applied.any()
    assert (data.qpos.tobytes(), data.time, data.ctrl.tobytes(), len(simulation.recorder)) == before
    assert simulation.error.startswith("controller two-part: ")
    assert re.search(reason, simulation.error)


def test_what_is_for_plots_may_be_missing(simulate):
    simulation = simulate()
    output = simulation.tick().output
    nowhere = np.full(2, np.nan)
    output = replace(
        output, zmp_wanted_in_world=nowhere, zmp_commanded_in_world=nowhere, delta_commanded=np.full(3, np.nan)
    )
    assert output_fault(output, 15) is None
    assert output_fault(replace(output, status=Status.HOLDING, infeasible=np.bool_(True)), 15) is None


def test_another_controller_goes_on_where_one_failed(spoilt, simulate):
    simulation = spoilt(explode)
    simulation.tick()
    simulation.switch(simulate("soft-qp").controller, "soft-qp")
    assert (simulation.fallen, simulation.error, simulation.stopped) == (None, None, False)
    for _ in range(100):
        assert simulation.tick().fall_cause is None
    assert simulation.time_s == pytest.approx(TICKS * 1e-3 + 0.1)


def test_a_fall_before_is_still_one_after_the_switch(spoilt, simulate):
    simulation = spoilt(explode)
    simulation.fallen, simulation.fall_time_s = "pelvis_low", 0.001
    simulation.tick()
    assert (simulation.fallen, simulation.stopped) == ("pelvis_low", True)
    simulation.switch(simulate().controller)
    assert (simulation.fallen, simulation.stopped) == ("pelvis_low", False)


def test_one_that_cannot_take_over_changes_nothing(simulate, scripted):
    class Stubborn(scripted):
        def reset(self, last_torques=None):
            raise RuntimeError("no")

    simulation = simulate()
    driver = simulation.controller
    with pytest.raises(ControllerError, match=r"controller guest: cannot take over \(RuntimeError: no\)"):
        simulation.switch(Stubborn(lambda tick: np.zeros(15)), "guest")
    assert simulation.controller is driver
    assert simulation.tick().fall_cause is None
