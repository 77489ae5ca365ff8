"""Joint friction fed forward: size and sign against MuJoCo's own, and by what it does to a standing robot."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from surefoot.control.controllers.two_part import TwoPart
from surefoot.control.joint_friction import SMOOTH, STICKS, FrictionCompensated
from surefoot.control.registry import controllers
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.model import DynamicsModel
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FULLY_LOADED
from surefoot.robot_import.load import load_robot_file
from surefoot.simulation.conventions import qpos_from_q
from surefoot.task.posture import solve_posture, standing_reference
from tests.support.small_biped import bent, biped

RUBBING = 'range="-1.5 1.5" armature="0.01" damping="0.4" frictionloss="0.8"'
SETTINGS = ControllerSettings(joint_friction_compensation=True)


@pytest.fixture
def file(tmp_path):
    (tmp_path / "small.xml").write_text(biped(joint=RUBBING))
    (tmp_path / "robot.toml").write_text(bent("small.xml"))
    return tmp_path / "robot.toml"


@pytest.fixture
def robot(file):
    return load_robot_file(file)


@pytest.fixture
def standing(robot):
    """Rates of the joints, and how far G is off -> terms and the reference."""
    dynamics, reference = DynamicsModel(robot), standing_reference(robot, Support.LEFT)
    q = solve_posture(dynamics, reference).q

    def at(rates=0.0, com_off=(0.0, 0.0, 0.0)):
        moved = standing_reference(robot, Support.LEFT)
        place = solve_posture(dynamics, _shifted(moved, com_off)).q if any(com_off) else q
        v = np.zeros(robot.dofs)
        v[6:] = rates
        return dynamics.evaluate(RobotState(place, v)), reference

    return at


def _shifted(reference, off):
    return replace(reference, position_com=reference.position_com + np.array(off))


def compensated(robot, settings=SETTINGS):
    return FrictionCompensated(TwoPart(robot, settings), robot, settings)


def test_of_moving_joints_it_is_what_mujocos_friction_takes(robot, standing):
    """Dampers, and dry friction as MuJoCo's solver finds it for a robot in free fall: the opposite of both."""
    rates = 5.0 * np.random.default_rng(3).choice((-1.0, 1.0), len(robot.joints))
    terms, reference = standing(rates)
    model = mujoco.MjModel.from_xml_string(robot.mjcf_xml)
    model.opt.gravity[:] = 0.0
    data = mujoco.MjData(model)
    data.qpos[:] = qpos_from_q(terms.state.q)
    data.qpos[2] += 1.0
    data.qvel[6:] = rates
    mujoco.mj_forward(model, data)
    assert data.ncon == 0
    taken = (data.qfrc_passive + data.qfrc_constraint)[6:]
    given = compensated(robot).torques(terms, reference)
    rubbing = np.array([joint.friction_nm > 0.0 for joint in robot.joints])
    assert rubbing.sum() == 12
    assert given == pytest.approx(-taken, rel=0.02, abs=1e-9)
    assert (given * rates >= 0.0).all() and (given * rates)[rubbing].min() > 3.0


def test_of_joints_that_stick_it_brings_the_com_back(robot, standing):
    """The sign by a second road: along the motion that undoes the error the torques' virtual power is positive."""
    controller = compensated(robot)
    for off in ((0.002, 0.0, 0.0), (-0.002, 0.0, 0.0), (0.0, 0.002, 0.0), (0.0, -0.002, 0.0)):
        terms, reference = standing(0.0, off)
        torques = controller.torques(terms, reference)
        step = 1e-4
        back = solve_posture(DynamicsModel(robot), _shifted(reference, np.array(off) * (1.0 - step))).q
        way = (back - terms.state.q)[7:] / step
        assert torques.dot(way) > 0.0
        assert np.abs(torques).max() <= 0.8 + 0.4 * np.abs(way).max() * 60.0 / 14.0 + 1e-9
    terms, reference = standing(0.0)
    assert np.abs(controller.torques(terms, reference)).max() < 1e-6


def test_it_is_smooth_and_never_more_than_the_friction(robot, standing):
    controller = compensated(robot)
    rates = np.linspace(-10.0 * STICKS, 10.0 * STICKS, 2001)
    found = np.array([controller.torques(*standing(rate))[0] for rate in rates[::20]])
    assert (np.abs(found) <= 0.8 + 0.4 * np.abs(rates[::20]) + 1e-9).all()
    assert np.abs(np.diff(found)).max() < 0.8 * 2.0 * np.diff(rates[::20]).max() / SMOOTH


def test_limits_of_the_motors_hold_and_the_rest_of_the_output_stays(robot, standing):
    terms, reference = standing(5.0)
    limit = 14.0  # less than one of the torques without it, and than another one with it
    weak = replace(robot, joints=tuple(replace(joint, torque_limit_nm=limit) for joint in robot.joints))
    bare, with_friction = TwoPart(robot, SETTINGS), FrictionCompensated(TwoPart(robot, SETTINGS), weak, SETTINGS)
    expected, output = (c.tick(terms, reference, FULLY_LOADED) for c in (bare, with_friction))
    wanted = expected.torques + with_friction.torques(terms, reference)
    own = expected.torques
    assert output.torques == pytest.approx(np.clip(wanted, np.minimum(own, -limit), np.maximum(own, limit)))
    assert (np.abs(own) > limit).any() and ((np.abs(own) < limit) & (np.abs(wanted) > limit)).any()
    assert output.status is expected.status and output.qp_method == expected.qp_method


def test_a_faulty_output_is_passed_on_for_the_loop_to_judge(robot, standing):
    class Careless:
        def tick(self, terms, reference, sensing):
            return "no output"

        def reset(self, last_torques=None):
            pass

    assert FrictionCompensated(Careless(), robot, SETTINGS).tick(*standing(), FULLY_LOADED) == "no output"


@pytest.mark.parametrize("name", ["two-part", "soft-qp", "optimization", "two-part-literal"])
def test_every_controller_takes_it_and_is_itself_without_it(robot, name):
    entry = controllers()[name]
    assert type(entry.make(robot, entry.settings())).__name__ != "FrictionCompensated"
    assert isinstance(entry.make(robot, entry.settings({"joint_friction_compensation": True})), FrictionCompensated)


@pytest.mark.parametrize("name", ["two-part", "soft-qp"])
def test_after_a_push_a_robot_that_rubs_ends_nearer(file, name):
    """1.1 s after the start of the same push, on the same robot: how far G is off, with and without."""
    push = {"direction_deg": 0.0, "impulse_ns": 1.0, "start_s": 0.1, "duration_s": 0.1}
    changes = {"robot": str(file), "duration_s": 1.2, **{f"pushes.0.{key}": value for key, value in push.items()}}
    off = []
    for switched in (False, True):
        scenario = load_scenario(
            "stand_left", {**changes, "controller.joint_friction_compensation": switched}, robot_files=True
        )
        summary = run(scenario, name).summary
        assert not summary["fell"]
        off.append(summary["com_error_final_m"])
    assert off[1] < 0.5 * off[0]
