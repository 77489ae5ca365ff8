"""A number that is none never reaches the motors, and never looks like survival."""

import numpy as np
import pytest

BAD = {"nan": np.nan, "infinite": np.inf, "minus infinite": -np.inf, "absurd": 1e300}


@pytest.mark.parametrize("bad", BAD.values(), ids=BAD.keys())
@pytest.mark.parametrize("torque_limits", [True, False])
def test_bad_torques_are_a_fall_and_do_not_reach_the_motors(simulate, scripted, bad, torque_limits):
    def torques(tick: int) -> np.ndarray:
        out = np.full(15, 1.0)
        if tick == 3:
            out[7] = bad
        return out

    simulation = simulate(physics={"torque_limits": torque_limits})
    simulation.controller = scripted(torques)
    for _ in range(3):
        assert simulation.tick().fall_cause is None
    data = simulation.plant.data
    before = data.qpos.copy(), data.time
    tick = simulation.tick()
    assert tick.fall_cause == simulation.fallen == "controller_error"
    assert "torques that no motor has" in simulation.error
    assert simulation.fall_time_s == pytest.approx(0.003, abs=1e-9)
    assert not tick.applied.any()
    for array in (data.ctrl, data.qpos, data.qvel, data.qfrc_actuator):
        assert np.isfinite(array).all()
    assert np.abs(data.ctrl).max() <= 1.0
    assert data.qpos.tolist() == before[0].tolist()  # nothing was stepped
    assert data.time == before[1]


def test_bad_torques_are_caught_while_a_switch_fades_in(simulate, scripted):
    simulation = simulate()
    for _ in range(10):
        simulation.tick()
    simulation.switch(scripted(lambda tick: np.full(15, np.nan)))
    assert simulation.tick().fall_cause == "controller_error"
    assert np.isfinite(simulation.plant.data.ctrl).all()


@pytest.mark.parametrize("size", [1e5, 6e5])
def test_a_bursting_simulation_is_a_fall_and_no_resurrection(simulate, scripted, size):
    """MuJoCo puts a robot whose state has burst back to its start, at time zero: that must not count as standing."""
    signs = np.where(np.arange(15) % 2, 1.0, -1.0)
    simulation = simulate(support="double", physics={"torque_limits": False})
    simulation.controller = scripted(lambda tick: size * signs * (-1.0 if tick // 7 % 2 else 1.0))
    times = [0.0]
    for _ in range(500):
        tick = simulation.tick()
        if tick.fall_cause:
            break
        times.append(simulation.time_s)
    assert (np.diff(times) > 0.0).all()
    assert simulation.fallen is not None


def test_a_fall_is_remembered_after_a_resurrection(simulate, scripted):
    simulation = simulate(support="double", physics={"torque_limits": False})
    simulation.controller = scripted(lambda tick: np.full(15, 6e5))
    for _ in range(300):
        simulation.tick()
    assert simulation.fallen is not None
    assert simulation.fall_time_s < 0.3
