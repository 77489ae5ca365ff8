"""A tick that fails is a status with a declared fallback: what each controller then does with the torques."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.control.balance.contact_wrench import joint_torques, required_wrench, share_between_feet
from surefoot.control.interface import STATUS_HELP, Status
from surefoot.control.registry import controller_named
from surefoot.control.task_acceleration import acceleration_response
from surefoot.momentum.delta import momentum_rate
from surefoot.robot.feet import Support
from surefoot.task.posture import standing_reference
from surefoot.task.reference import tracking_acceleration

UNLIMITED = {"saturation": "none", "guard": False, "roll_gate": False}


@pytest.fixture
def tick(robot, standing, on_its_feet):
    """Controller and how far ahead the CoM is wanted [m] -> output of one tick at rest in left stance."""

    def decide(controller, ahead_m: float = 0.0):
        terms = standing(Support.LEFT)
        reference = standing_reference(robot, Support.LEFT)
        reference = replace(reference, position_com=reference.position_com + [ahead_m, 0.0, 0.0])
        return controller.tick(terms, reference, on_its_feet(terms, Support.LEFT)[1])

    return decide


@pytest.fixture
def build(robot):
    def make(name: str, **changes):
        entry = controller_named(name)
        return entry.build(robot, entry.settings(changes))

    return make


REACHABLE, IMPOSSIBLE = 0.005, 0.2  # K_P e = 0.3 m/s2 and 12 m/s2, which asks for a ZMP more than a metre behind


def test_unlatched_optimization_holds_while_infeasible_and_tries_again(build, tick):
    controller = build("optimization")
    solved = tick(controller)
    assert solved.status is Status.SOLVED
    held = tick(controller, IMPOSSIBLE)
    assert held.status is Status.HOLDING
    assert held.infeasible
    assert_allclose(held.torques, solved.torques, rtol=0, atol=0)
    again = tick(controller, REACHABLE)
    assert again.status is Status.SOLVED
    assert not again.infeasible
    assert np.abs(again.torques - solved.torques).max() > 1.0


def test_latched_optimization_holds_for_ever(build, tick):
    controller = build("optimization", latched=True)
    solved = tick(controller)
    for ahead in (IMPOSSIBLE, REACHABLE, 0.0):
        held = tick(controller, ahead)
        assert held.status is Status.HOLDING
        assert held.infeasible
        assert_allclose(held.torques, solved.torques, rtol=0, atol=0)
    controller.reset()
    assert tick(controller, REACHABLE).status is Status.SOLVED


def test_optimization_that_starts_infeasible_holds_what_it_was_handed(build, tick):
    controller = build("optimization")
    assert not tick(controller, IMPOSSIBLE).torques.any()
    handed = np.arange(15.0)
    controller.reset(handed)
    assert_allclose(tick(controller, IMPOSSIBLE).torques, handed, rtol=0, atol=0)


def test_latched_torques_stay_constant_in_the_simulation(simulate):
    """The paper's Figure 8: from the first infeasible tick on every torque is a constant."""
    swing = {"kind": "swing", "axis": "lateral", "amplitude_m": -0.05, "duration_s": 0.4, "start_s": 0.0}
    simulation = simulate("optimization", reference=swing, controller={"latched": True})
    outputs = [simulation.tick().output for _ in range(200)]
    first = next(i for i, output in enumerate(outputs) if output.infeasible)
    assert 0 < first < 150
    assert all(output.infeasible for output in outputs[first:])
    for output in outputs[first:]:
        assert_allclose(output.torques, outputs[first - 1].torques, rtol=0, atol=0)


def test_two_part_falls_back_to_clipped_inverse_dynamics(robot, standing, on_its_feet, build, tick):
    """Unlimited, told to be elsewhere at once: no contact forces give those ankle torques, so that the QP must fail."""
    output = tick(build("two-part", **UNLIMITED), IMPOSSIBLE)
    assert output.status is Status.FALLBACK
    assert output.infeasible
    terms = standing(Support.LEFT)
    reference = standing_reference(robot, Support.LEFT)
    reference = replace(reference, position_com=reference.position_com + [IMPOSSIBLE, 0.0, 0.0])
    settings = controller_named("two-part").settings(UNLIMITED)
    command = tracking_acceleration(terms, reference, settings.stiffness(21), settings.damping(21))
    command[6:12] = 0.0  # the stance foot is at rest and stays so
    q_dd = acceleration_response(terms, command).acceleration
    geometry, _ = on_its_feet(terms, Support.LEFT)
    wrench = required_wrench(terms, momentum_rate(terms, q_dd), geometry)
    unclipped = joint_torques(terms, q_dd, share_between_feet(wrench, terms, geometry))
    assert (np.abs(unclipped) > robot.torque_limits).any()
    assert_allclose(output.torques, np.clip(unclipped, -robot.torque_limits, robot.torque_limits), rtol=0, atol=1e-8)


def test_limited_two_part_never_needs_its_fallback_there(build, tick):
    output = tick(build("two-part"), IMPOSSIBLE)
    assert output.status is Status.SOLVED
    assert output.guard_active


def test_soft_qp_gives_up_the_motion_and_not_the_contact(build, tick):
    output = tick(build("soft-qp"), IMPOSSIBLE)
    assert output.status is Status.SOLVED
    assert output.guard_active


@pytest.mark.parametrize("name", ["two-part", "soft-qp"])
def test_a_qp_without_a_solver_answer_is_counted_never_swallowed(robot, build, tick, monkeypatch, name):
    """Whatever the reason that a solver gives up: clipped inverse dynamics, and the tick says so."""
    from surefoot.control.controllers import soft_qp, two_part
    from surefoot.control.qp import solver

    nothing = solver.QPSolution(None, "daqp", None, None, None)  # type: ignore[arg-type]
    for module in (soft_qp, two_part):
        monkeypatch.setattr(module, "solve_qp", lambda qp, which: nothing)
    output = tick(build(name))
    assert output.status is Status.FALLBACK
    assert output.infeasible
    assert (np.abs(output.torques) <= robot.torque_limits).all()
    monkeypatch.undo()
    # at rest nothing is in conflict: the fallback is the motion that the QP would have found
    assert_allclose(output.torques, tick(build(name)).torques, rtol=0, atol=0.5)


def test_a_failing_qp_in_front_of_the_ankle_law_is_reported_too(build, tick, monkeypatch):
    """With delta_P from the q'' that a soft QP allows, that QP's failure must not be swallowed either."""
    from surefoot.control.controllers import two_part
    from surefoot.control.qp import solver

    nothing = solver.QPSolution(None, "daqp", None, None, None)  # type: ignore[arg-type]
    monkeypatch.setattr(two_part, "solve_qp", lambda qp, which: nothing)
    assert tick(build("two-part", delta_source="qp", other_joints="inverse-dynamics")).infeasible


def test_every_status_says_what_to_try_next():
    assert set(STATUS_HELP) == set(Status)
