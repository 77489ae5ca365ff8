"""A run repeats to the bit: the loop reads no clock and draws no numbers."""

import numpy as np
import pytest

SCENARIO = {
    "pushes": [{"link": "trunk", "direction_deg": 40.0, "impulse_ns": 6.0, "start_s": 0.05, "duration_s": 0.1}],
    "stones": [{"x_m": 0.05, "y_m": 0.07, "height_m": 0.006, "rise_start_s": 0.1, "rise_duration_s": 0.1}],
}
TICKS = 300


def table_of(simulation) -> np.ndarray:
    for _ in range(TICKS):
        simulation.tick()
    return simulation.recorder.table()


@pytest.mark.parametrize("controller", ["two-part", "optimization", "soft-qp", "two-part-literal"])
def test_two_identical_runs_are_identical_to_the_bit(simulate, controller):
    first, second = (table_of(simulate(controller, **SCENARIO)) for _ in range(2))
    assert len(first) == TICKS
    assert first.tobytes() == second.tobytes()


def test_runs_that_take_turns_do_not_disturb_each_other(simulate):
    alone = table_of(simulate(**SCENARIO))
    one, other = simulate(**SCENARIO), simulate("soft-qp", support="right")
    for _ in range(TICKS):
        one.tick()
        other.tick()
    assert one.recorder.table().tobytes() == alone.tobytes()


def test_a_timing_probe_changes_nothing(simulate):
    plain, probed = simulate(**SCENARIO), simulate(**SCENARIO)
    counter = iter(range(10**6))
    probed._clock = lambda: next(counter)
    assert table_of(plain).tobytes() == table_of(probed).tobytes()
    assert len(probed.tick_ns) == TICKS
    assert plain.tick_ns == []
