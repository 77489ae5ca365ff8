"""What several folders of tests share."""

import os

from surefoot.blas_threads import ONE_THREAD

os.environ.update(ONE_THREAD | os.environ)  # before NumPy is imported: a walk takes a fifth of the time

import shutil
import subprocess
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from surefoot.control.balance.support import SupportGeometry, support_geometry
from surefoot.dynamics.model import DynamicsModel
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.robot.description import RobotDescription, RobotState, load_robot
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing
from surefoot.simulation.loop import Simulation
from surefoot.task.posture import solve_posture, standing_reference
from tests.support.cli import FULL_EXAMPLE, call_surefoot

# Tests of such a folder stay in one process: those of the browser would take it from one another, and the others
# share a fixture that takes long to make. Elsewhere the tests of a file stay together.
TOGETHER = ("tests/browser/", "tests/experiments/bench/", "tests/experiments/paper/")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log):
    """Say which tests a process of pytest-xdist takes as a whole; in the order of collection, the browser's first."""
    from xdist.scheduler import LoadScopeScheduling

    class FoldersAndFiles(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.split("::")[0]
            return next((folder for folder in TOGETHER if file.startswith(folder)), file)

    config.option.loadscopereorder = False
    return FoldersAndFiles(config, log)


@pytest.fixture(scope="session")
def chromium_path() -> str:
    """Chromium for tests marked ``browser``, as Playwright's ``executable_path``; skips where there is none."""
    for name in (os.environ.get("SUREFOOT_CHROMIUM", ""), "chromium", "chromium-browser", "google-chrome"):
        if name and (path := shutil.which(name)):
            return path
    pytest.skip("needs Chromium: install it or name it in SUREFOOT_CHROMIUM")


@pytest.fixture(scope="session")
def surefoot() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Arguments -> the finished command."""
    return call_surefoot


@pytest.fixture(scope="session")
def full_example() -> str:
    """A scenario file with every table of the documentation."""
    return FULL_EXAMPLE


@pytest.fixture(scope="session")
def robot() -> RobotDescription:
    return load_robot("bip")


@pytest.fixture(scope="session")
def dynamics(robot) -> DynamicsModel:
    return DynamicsModel(robot)


@pytest.fixture(scope="session")
def random_state(robot, dynamics) -> Callable[..., RobotState]:
    """Seed -> a state: joints inside their ranges, any pelvis pose, velocities of about 1 m/s and 1 rad/s."""

    def draw(seed: int, *, speed: float = 1.0) -> RobotState:
        rng = np.random.default_rng(seed)
        pose = np.concatenate((rng.normal(size=6), np.zeros(15)))
        q = dynamics.integrate(dynamics.neutral(np.zeros(3)), pose)
        q[7:] = rng.uniform(robot.joint_lower, robot.joint_upper)
        return RobotState(q, speed * rng.normal(size=21))

    return draw


@pytest.fixture(scope="session")
def standing(robot, dynamics) -> Callable[..., DynamicsTerms]:
    """Support and velocity (21,) -> the dynamics of the standing posture."""

    def evaluate(support: Support, velocity: np.ndarray | None = None) -> DynamicsTerms:
        posture = solve_posture(dynamics, standing_reference(robot, support))
        return dynamics.evaluate(RobotState(posture.q, np.zeros(21) if velocity is None else velocity))

    return evaluate


@pytest.fixture(scope="session")
def simulate() -> Callable[..., Simulation]:
    """Keys of a scenario file (left support unless told) and a controller's name -> a simulation ready to tick."""

    def build(controller_name: str = "two-part", *, rows: int = 10_000, **table: Any) -> Simulation:
        scenario = scenario_from_table({"robot": "bip", "support": "left", "duration_s": 60.0, **table})
        return build_simulation(scenario, controller_name, rows=rows).simulation

    return build


@pytest.fixture(scope="session")
def on_its_feet(robot) -> Callable[..., tuple[SupportGeometry, FootSensing]]:
    """Terms and support -> the support geometry and the sensing of a robot whose stance feet carry equal loads."""

    def sense(terms: DynamicsTerms, support: Support) -> tuple[SupportGeometry, FootSensing]:
        wrenches = np.zeros((2, 6))
        wrenches[list(support.stance), 2] = terms.mass_kg * terms.gravity / len(support.stance)
        sensing = FootSensing(wrenches)
        return support_geometry(robot, terms, support, sensing), sensing

    return sense
