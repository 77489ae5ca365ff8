"""The reference planner: what it computes is what an exactly tracked reference does, and it refuses in time."""

import numpy as np
import pytest

from surefoot.control.balance_plan import edge_name, plan_balance
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.robot.feet import Support
from surefoot.task.posture import standing_reference
from surefoot.task.reference import Hold, Swing

FEASIBLE = ReferenceSpec(kind="swing", axis="lateral", amplitude_m=-0.02, duration_s=0.6, start_s=0.2)


@pytest.fixture(scope="module")
def posture(robot):
    return standing_reference(robot, Support.LEFT)


def swing(posture, amplitude: float, duration: float = 0.5, axis: int = 1) -> Swing:
    return Swing(posture, axis, amplitude, duration, 0.2)


def test_standing_still_needs_no_delta_and_has_its_zmp_below_the_com(robot, posture):
    plan = plan_balance(DynamicsModel(robot), Hold(posture), np.array([0.0, 1.0]))
    assert np.abs(plan.delta_p_in_world).max() < 1e-6
    assert np.abs(plan.zmp_in_world - posture.position_com[:2]).max() < 1e-9
    assert plan.exit is None


def test_plan_is_what_the_robot_then_does(robot, posture):
    """Measured delta_P and ZMP of the plant against the plan, along a feasible swing."""
    result = run(Scenario(duration_s=1.0, reference=FEASIBLE), "two-part").recorder
    t = result.column("time_s")[200:800:20]
    plan = plan_balance(DynamicsModel(robot), swing(posture, FEASIBLE.amplitude_m, FEASIBLE.duration_s), t)
    measured_zmp = np.column_stack([result.column(f"zmp_{a}_m")[200:800:20] for a in "xy"])
    measured_delta = np.column_stack([result.column(f"delta_measured_{a}_nm")[200:800:20] for a in "xyz"])
    size = np.abs(plan.delta_p_in_world[:, 0]).max()
    assert size > 20.0  # the swing asks for something
    # what remains is the compliance of the ground: 0.1 mm of sinking, a damped contact
    assert np.abs(measured_delta - plan.delta_p_in_world)[:, :2].max() < 0.05 * size
    assert np.abs(measured_zmp - plan.zmp_in_world).max() < 0.002


@pytest.mark.parametrize(
    ("axis", "amplitude", "edge"), [(1, -0.05, "outer"), (1, 0.04, "inner"), (0, 0.09, "heel"), (0, -0.09, "toe")]
)
def test_infeasible_swing_is_shown_with_time_and_edge(robot, posture, axis, amplitude, edge):
    """A swing inward first pushes off against the outer edge, and so on."""
    reference = swing(posture, amplitude, 0.45, axis)
    plan = plan_balance(DynamicsModel(robot), reference, np.arange(0.19, 0.67, 0.002))
    assert plan.exit is not None
    assert plan.exit.edge == edge
    assert 0.2 < plan.exit.time_s < 0.2 + 0.45 / 2
    first = int(np.argmax(plan.margin_m < 0.0))
    assert plan.time_s[first] == plan.exit.time_s
    assert plan.exit.worst_m == -plan.margin_m.min()


def test_feed_forward_tracks_with_less_error_than_feedback_alone():
    errors = {
        form: run(Scenario(duration_s=1.2, reference=FEASIBLE, controller={"feedforward": form}), "two-part").summary[
            "com_error_max_m"
        ]
        for form in ("none", "planned", "acceleration")
    }
    assert errors["planned"] < 0.2 * errors["none"]
    assert errors["planned"] == pytest.approx(errors["acceleration"], rel=0.05)  # two forms of one feed-forward


def test_run_refuses_to_feed_forward_an_infeasible_plan():
    spec = ReferenceSpec(kind="swing", amplitude_m=-0.05, duration_s=0.4, start_s=0.2)
    with pytest.raises(InvalidInput, match=r"outer edge at 0\.2\d\d s"):
        run(Scenario(duration_s=1.0, reference=spec, controller={"feedforward": "planned"}), "two-part")


@pytest.mark.parametrize(
    ("normal", "support", "name"),
    [
        ((1.0, 0.0), Support.LEFT, "toe"),
        ((-1.0, 0.1), Support.RIGHT, "heel"),
        ((0.1, 1.0), Support.LEFT, "outer"),
        ((0.1, 1.0), Support.RIGHT, "inner"),
        ((0.0, -1.0), Support.RIGHT, "outer"),
        ((0.0, -1.0), Support.DOUBLE, "right"),
    ],
)
def test_edges_have_names(normal, support, name):
    assert edge_name(np.array(normal), support) == name
