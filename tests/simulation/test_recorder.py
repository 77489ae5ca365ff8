"""The record: what is in its columns, and which rows remain when it is full."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.simulation.recorder import Recorder


def test_columns_are_what_happened(simulate):
    push = {"direction_deg": 30.0, "impulse_ns": 8.0, "start_s": 0.0, "duration_s": 0.1}
    simulation = simulate(pushes=[push])
    ticks = [simulation.tick() for _ in range(60)]
    recorder = simulation.recorder
    assert len(recorder) == 60
    assert_allclose(recorder.column("time_s"), 1e-3 * np.arange(60), rtol=0, atol=1e-9)
    for axis, letter in enumerate("xyz"):
        com = [tick.terms.position_com_in_world[axis] for tick in ticks]
        assert recorder.column(f"com_{letter}_m").tolist() == com
        commanded = [tick.output.delta_commanded[axis] for tick in ticks]
        assert recorder.column(f"delta_commanded_{letter}_nm").tolist() == commanded
    assert recorder.column("zmp_x_m").tolist() == [tick.balance.zmp_in_world[0] for tick in ticks]
    assert recorder.column("force_left_n").tolist() == [tick.balance.normal_forces[0] for tick in ticks]
    for i, joint in enumerate(simulation.robot.joints):
        assert recorder.column(f"torque_{joint.name}_nm").tolist() == [tick.applied[i] for tick in ticks]
        angles = [tick.terms.state.q[joint.dof + 1] for tick in ticks]
        assert recorder.column(f"angle_{joint.name}_rad").tolist() == angles


def test_commanded_and_measured_delta_are_both_logged_and_agree_where_the_model_is_right(simulate):
    """In steady motion the plant does what was commanded: delta_P measured on the ground meets the command."""
    swing = {"kind": "swing", "axis": "lateral", "amplitude_m": -0.02, "duration_s": 0.4, "start_s": 0.0}
    simulation = simulate(reference=swing)
    for _ in range(300):
        simulation.tick()
    recorder = simulation.recorder
    commanded, measured = (recorder.column(f"delta_{what}_x_nm")[50:] for what in ("commanded", "measured"))
    assert np.abs(commanded).max() > 10.0
    # contact of 6 ms lags behind, the command is of the tick: some per cent of the greatest value
    assert np.abs(commanded - measured).max() < 0.1 * np.abs(commanded).max()


def rows_of(simulation, capacity: int, ticks: int) -> Recorder:
    recorder = Recorder([joint.name for joint in simulation.robot.joints], capacity)
    simulation.recorder = recorder
    for _ in range(ticks):
        simulation.tick()
    return recorder


@pytest.mark.parametrize("ticks", [5, 10, 11, 25, 30])
def test_when_full_the_oldest_rows_make_room(simulate, ticks):
    recorder = rows_of(simulate(), 10, ticks)
    kept = list(range(max(0, ticks - 10), ticks))
    assert len(recorder) == len(kept)
    assert_allclose(recorder.column("time_s"), 1e-3 * np.array(kept), rtol=0, atol=1e-9)
    assert_allclose(recorder.last(4)[:, 0], 1e-3 * np.array(kept[-4:]), rtol=0, atol=1e-9)
    assert_allclose(recorder.last(99)[:, 0], recorder.column("time_s"), rtol=0, atol=0)


def test_what_it_hands_out_are_copies(simulate):
    recorder = rows_of(simulate(), 10, 15)
    recorder.table()[:], recorder.last(3)[:] = -1.0, -1.0
    assert recorder.column("time_s").min() > 0.0
    recorder.clear()
    assert len(recorder) == 0
    assert recorder.table().shape == (0, len(recorder.columns))


def test_column_names_are_unique_and_carry_their_unit(simulate):
    columns = simulate().recorder.columns
    assert len(set(columns)) == len(columns)
    plain = ("status", "guard", "gate", *(f"pelvis_q{a}" for a in "xyzw"))
    units = ("_s", "_m", "_mps", "_nm", "_n", "_rad")
    assert all(name.endswith(units) for name in columns if name not in plain)
