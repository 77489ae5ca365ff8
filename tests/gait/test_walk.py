"""A robot that walks: short walks in the real simulation."""

import math
from dataclasses import replace

import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import Scenario, load_scenario
from surefoot.gait.progress import Phase
from surefoot.gait.walk import FIRST_SHIFT_S, LAST_SHIFT_S
from surefoot.robot.feet import Support
from surefoot.simulation.stones import Stone

CONTROLLERS = ("two-part", "soft-qp", "optimization")


def walk_flat(steps: int, **changes) -> Scenario:
    """The shipped scenario with fewer steps, and so much time that it stands for 2 s at its end."""
    table = {"reference.steps": steps, **{f"reference.{name}": value for name, value in changes.items()}}
    scenario = load_scenario("walk_flat", table)
    spec = scenario.reference
    return replace(scenario, duration_s=math.ceil(spec.start_s + 1.1 + steps * spec.step_period_s + 2.1))


def simulation_of(scenario: Scenario, controller: str = "two-part"):
    return build_simulation(scenario, controller, rows=scenario.ticks).simulation


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_every_controller_walks_on_flat_ground_and_stands_afterwards(controller):
    summary = run(walk_flat(3, step_period_s=0.6), controller).summary
    assert summary["walk_completed"]
    assert (summary["steps_made"], summary["steps_planned"]) == (3, 3)
    assert summary["distance_m"] == pytest.approx(2 * 0.2, abs=0.02)  # the last step sets the feet beside each other
    assert summary["first_limit"] is None
    assert summary["qp_infeasible_ticks"] == summary["fallback_ticks"] == 0


def test_a_turn_on_the_spot_turns_the_robot_and_keeps_its_place():
    simulation = simulation_of(
        walk_flat(3, step_length_m=0.0, step_period_s=0.6, turn_deg_per_step=10.0, first_foot="right")
    )
    for _ in range(3_400):
        result = simulation.tick()
    assert simulation.gait.phase is Phase.STANDING
    forward = simulation.plant.link_rotation("trunk")[:, 0]
    assert math.degrees(math.atan2(forward[1], forward[0])) == pytest.approx(20.0, abs=2.0)
    assert result.terms.position_com_in_world[:2] == pytest.approx([0.0, 0.0], abs=0.05)


def test_the_feet_take_turns_and_land_where_they_should():
    simulation = simulation_of(walk_flat(3))
    phases, supports, landed, told = [], [], [], []
    for _ in range(4_000):
        made = simulation.gait.made
        result = simulation.tick()
        if not phases or phases[-1] is not simulation.gait.phase:
            phases.append(simulation.gait.phase)
            supports.append(simulation.support)
            told.append(simulation.gait.progress)
            assert simulation.gait.steps_ahead == simulation.gait.footsteps[simulation.gait.made :]
        if simulation.gait.made > made:
            step = simulation.gait.footsteps[made]
            landed.append(result.terms.feet[step.foot].position_ankle_in_world[:2] - step.point)
    swing = [Phase.SINGLE, Phase.DOUBLE]
    assert phases == [Phase.WAITING, Phase.DOUBLE, *swing, *swing, *swing, Phase.STANDING]
    alone = [support for phase, support in zip(phases, supports, strict=True) if phase is Phase.SINGLE]
    assert alone == [Support.RIGHT, Support.LEFT, Support.RIGHT]  # the left foot goes first
    assert [progress.alone for progress in told if progress.phase is Phase.SINGLE] == [1, 0, 1]
    assert [(progress.made, progress.planned) for progress in (told[0], told[3], told[-1])] == [(0, 3), (1, 3), (3, 3)]
    assert np.abs(landed).max() < 0.015


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_nobody_knows_of_a_stone_before_a_foot_feels_it(controller):
    """A stone under the second step: all torques are the same to the bit until the foot touches it."""
    bare, stony = (simulation_of(walk_flat(3, step_period_s=0.6), controller) for _ in range(2))
    stony.plant.stones.place(Stone(x_m=0.42, y_m=-0.11, height_m=0.02, rise_start_s=0.0, rise_duration_s=0.05))
    felt = False
    for _ in range(4_000):  # far more than two steps take
        if min(stony.gait.made, bare.gait.made) >= 2:
            break
        one, other = bare.tick(), stony.tick()
        felt = felt or one.balance.normal_forces != other.balance.normal_forces
        if not felt:
            assert one.output.torques.tobytes() == other.output.torques.tobytes()
    assert felt
    assert min(stony.gait.made, bare.gait.made) >= 2  # both have made the step that is compared
    assert one.output.torques.tobytes() != other.output.torques.tobytes()


def test_a_foot_that_lands_early_ends_its_swing_at_once():
    def lands_at(height_m: float) -> float:
        simulation = simulation_of(walk_flat(1))
        if height_m > 0.0:
            simulation.plant.stones.place(
                Stone(x_m=0.22, y_m=0.11, height_m=height_m, size_m=(0.3, 0.2), rise_start_s=0.8, rise_duration_s=0.3)
            )
        while simulation.gait.made == 0:
            simulation.tick()
        assert simulation.gait.phase is Phase.DOUBLE
        return simulation.time_s

    expected = 0.2 + FIRST_SHIFT_S + 0.8 * 0.8  # start, shift, swing
    assert lands_at(0.0) == pytest.approx(expected, abs=0.03)
    assert lands_at(0.02) < expected - 0.05


def test_a_walk_goes_on_the_same_to_the_bit_from_a_checkpoint():
    simulation = simulation_of(walk_flat(3))

    def ticks(number: int) -> list[bytes]:
        return [simulation.tick().output.torques.tobytes() for _ in range(number)]

    ticks(1_000)  # in the first swing
    assert simulation.gait.phase is Phase.SINGLE
    kept = simulation.checkpoint()
    once = ticks(1_500)
    simulation.restore(kept)
    assert simulation.gait.made == 0
    assert ticks(1_500) == once


def test_the_energy_is_that_of_the_recorded_torques_and_angles():
    scenario = walk_flat(2)
    result = run(scenario, "two-part")
    table = dict(zip(result.recorder.columns, result.recorder.table().T, strict=True))
    names = [name.removeprefix("torque_").removesuffix("_nm") for name in table if name.startswith("torque_")]
    turned = np.diff([table[f"angle_{name}_rad"] for name in names], axis=1)
    torques = np.array([table[f"torque_{name}_nm"] for name in names])[:, :-1]
    stands_s = scenario.reference.start_s + FIRST_SHIFT_S + 2 * 0.64 + 0.16 + LAST_SHIFT_S
    walks = (table["time_s"][:-1] >= scenario.reference.start_s) & (table["time_s"][:-1] < stands_s)
    energy = np.abs(torques * turned)[:, walks].sum()
    assert result.summary["energy_j"] == pytest.approx(energy, rel=0.02)
    way = result.summary["distance_m"]
    weight = 105.0 * 9.81
    assert result.summary["cost_of_transport"] == pytest.approx(energy / (weight * way), rel=0.03)


def test_a_walk_starts_on_two_feet():
    with pytest.raises(InvalidInput, match="starts on two feet"):
        load_scenario("walk_flat", {"support": "left"})
