"""Bodies with several hinges are the robot that MuJoCo makes of them, and that of the twin with one hinge a body."""

import mujoco
import numpy as np
import pytest

from surefoot.dynamics.links import evaluate_links
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import RobotState
from surefoot.robot.pinocchio_library import pin
from surefoot.robot_import.agreement import LARGEST_DIFFERENCE, compare, pinocchio_model
from surefoot.robot_import.describe import describe
from surefoot.robot_import.normalise import plain_mjcf
from surefoot.robot_import.report import report
from tests.support.several_hinges import AXES, several_hinges

LEG = ["hip_x", "hip_z", "hip_y", "knee", "ankle_y", "ankle_x"]
TURNED = 'pos="0.3 0.2 0.7" quat="0.9 0.3 -0.2 0.1"'


@pytest.fixture
def robot(inspect):
    return inspect(several_hinges()).robot


def axis(name: str) -> np.ndarray:
    numbers = np.array(AXES[name][0].split(), dtype=float)
    return numbers / np.linalg.norm(numbers)


def mass_matrix(model: mujoco.MjModel, qpos: np.ndarray) -> np.ndarray:
    data, matrix = mujoco.MjData(model), np.zeros((model.nv, model.nv))
    data.qpos[:] = qpos
    mujoco.mj_forward(model, data)
    mujoco.mj_fullM(model, data, matrix)
    return matrix


def random_qpos(model: mujoco.MjModel, seed: int) -> np.ndarray:
    qpos = np.random.default_rng(seed).uniform(-1.0, 1.0, model.nq)
    qpos[3:7] /= np.linalg.norm(qpos[3:7])
    return qpos


def test_it_is_fit_and_the_report_says_which_bodies_they_are(inspect):
    table = report(inspect(several_hinges()))
    assert table["fit"], table["problems"]
    assert table["legs"]["left"] == [f"left_{name}" for name in LEG]
    assert table["feet"]["left"]["body"] == "left_foot"
    assert table["feet"]["left"]["ankle"]["order"] == "pitch, roll"
    line = next(line for line in table["changed"] if "several hinges" in line)
    assert line.endswith("left_thigh (3), left_foot (2), right_thigh (3), right_foot (2), trunk (2), arm (2)")


@pytest.mark.parametrize("pose", ['pos="0 0 0.7"', TURNED])
def test_both_libraries_have_the_same_mass_matrix_com_and_bias(inspect, pose):
    found = inspect(several_hinges(pose=pose)).robot.agreement
    assert found.same_names
    assert found.dofs == (22, 22)
    assert max(found.mass_matrix, found.com_m, found.bias) < 1e-11


def test_another_order_of_the_hinges_is_found_out(robot):
    """So that the comparison cannot pass whatever it is given."""
    mjcf = robot.plain.text()
    names = [f"left_{name}" for name in ("hip_x", "hip_z")]
    swapped = mjcf.replace(names[0], "?").replace(names[1], names[0]).replace("?", names[1])
    model = mujoco.MjModel.from_xml_string(mjcf)
    other = pinocchio_model(swapped)
    assert not compare(model, other).same_names
    again = pinocchio_model(mjcf)
    thigh = again.getJointId("left_hip_z")
    again.jointPlacements[thigh] = again.jointPlacements[thigh] * pin.SE3(np.eye(3), np.array((0.0, 1e-6, 0.0)))
    found = compare(model, again)
    assert found.same_names
    assert min(found.mass_matrix, found.com_m, found.bias) > LARGEST_DIFFERENCE


def test_the_first_hinge_is_the_outermost(robot):
    """R of the thigh is the product of the three turns in the order of the file, as written out by hand."""
    model, q = robot.pinocchio, pin.neutral(robot.pinocchio)
    angles = dict(zip(LEG[:3], (0.5, -0.7, 0.9), strict=True))
    wanted = np.eye(3)
    for name, angle in angles.items():
        q[model.joints[model.getJointId(f"left_{name}")].idx_q] = angle
        wanted = wanted @ pin.exp3(angle * axis(name))
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    assert np.allclose(data.oMf[model.getFrameId("left_thigh")].rotation, wanted, atol=1e-14)


def test_m_is_that_of_the_twin_with_one_hinge_a_body():
    one, other = (mujoco.MjModel.from_xml_string(several_hinges(apart=apart)) for apart in (False, True))
    assert one.nbody < other.nbody
    for seed in range(5):
        qpos = random_qpos(one, seed)
        assert np.allclose(mass_matrix(one, qpos), mass_matrix(other, qpos), rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("controller", ["two-part", "soft-qp"])
def test_a_run_is_that_of_the_twin_to_rounding(tmp_path, controller):
    """The twin's traces of mass and another order of the sums are all that differs: next to nothing in 200 ticks."""
    push = [{"start_s": 0.05, "direction_deg": 90.0, "impulse_ns": 1.0, "duration_s": 0.05}]
    records = []
    for apart in (False, True):
        file = tmp_path / f"{apart}.xml"
        file.write_text(several_hinges(apart=apart))
        over = {"duration_s": 0.2, "pushes": push, "robot": str(file)}
        records.append(run(load_scenario("stand_left", over, robot_files=True), controller))
    one, other = records
    assert one.summary["com_error_max_m"] > 1e-3  # the push was felt
    for column, most in (("angle", 1e-11), ("torque", 1e-8), ("com", 1e-11), ("delta", 1e-8)):
        names = [name for name in one.recorder.columns if name.startswith(f"{column}_")]
        difference = [one.recorder.column(name) - other.recorder.column(name) for name in names]
        assert np.abs(difference).max() < most, column


def test_one_of_three_hinges_can_be_frozen():
    """M without its row is M of the robot without it, at its angle: the axes of those before it turn along."""
    original = mujoco.MjModel.from_xml_string(several_hinges())
    qpos, frozen = random_qpos(original, 3), ["left_hip_z", "right_ankle_y"]
    plain = plain_mjcf(original, qpos, frozen)
    model = mujoco.MjModel.from_xml_string(plain.text())
    gone = [int(original.joint(name).qposadr[0]) for name in frozen]
    rows = [dof for dof in range(original.nv) if dof + 1 not in gone]
    wanted = mass_matrix(original, qpos)[np.ix_(rows, rows)]
    assert np.allclose(mass_matrix(model, np.delete(qpos, gone)), wanted, rtol=0.0, atol=1e-12)
    found = compare(model, pinocchio_model(plain.text()))
    assert max(found.mass_matrix, found.com_m, found.bias) < 1e-11


def test_the_massless_links_are_no_links_of_the_robot(robot):
    description = describe(robot)
    plant = mujoco.MjModel.from_xml_string(description.mjcf_xml)
    assert set(description.links) == {plant.body(body).name for body in range(1, plant.nbody)}
    assert ("pelvis", "left_thigh", "left_shin", "left_foot") in description.link_chains
    q = pin.neutral(description.pinocchio_model)
    motions = evaluate_links(description, RobotState(q, np.zeros(22)), np.zeros(22))
    assert set(motions.names) == set(description.links)
    assert motions.mass_kg.min() > 0.0
    assert motions.mass_kg.sum() == pytest.approx(description.mass_kg, rel=1e-14)
