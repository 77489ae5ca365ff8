"""Where the robot's links are while a case runs: what Figure 1 is drawn from, and the recorder does not keep."""

from dataclasses import dataclass

import numpy as np

from surefoot.experiments.runs.cases import Case
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.simulation.physics import TIMESTEP_S
from surefoot.simulation.stones import Stone

LEGS = (
    ("l_foot", "l_shank", "l_thigh", "pelvis", "r_thigh", "r_shank", "r_foot"),
    ("pelvis", "lumbar_lever", "trunk"),
)  # chains of joint centres


@dataclass(frozen=True, eq=False)
class Pose:
    """The robot at one instant; world axes.

    Attributes:
        time_s: when.
        chains: lines through joint centres, each (k, 3) [m]; the trunk's ends at its centre of mass.
        soles: left and right: corners of the sole (4, 3) [m].
        ankle: centre of the stance ankle (3,) [m].
        com: centre of mass (3,) [m].
        zmp: measured ZMP (2,) [m].
        stones: where the stones are.
    """

    time_s: float
    chains: tuple[np.ndarray, ...]
    soles: tuple[np.ndarray, np.ndarray]
    ankle: np.ndarray
    com: np.ndarray
    zmp: np.ndarray
    stones: tuple[Stone, ...]


@dataclass(frozen=True, eq=False)
class PoseTrack:
    """A case seen at some instants.

    Attributes:
        case: what was run.
        poses: those of the instants asked for that came before the fall, and the last one.
        fall_time_s: when it fell, or None.
    """

    case: Case
    poses: tuple[Pose, ...]
    fall_time_s: float | None


def watch_poses(case: Case, times_s: tuple[float, ...]) -> PoseTrack:
    """Run a case, tick for tick as ``run`` does, and keep the pose at some instants."""
    scenario = load_scenario(case.scenario, dict(case.changes))
    simulation = build_simulation(scenario, case.controller, rows=1).simulation
    wanted = {round(time / TIMESTEP_S) for time in times_s}
    plant, robot, poses, last = simulation.plant, simulation.robot, [], None
    for tick in range(scenario.ticks):
        result = simulation.tick()
        if simulation.stopped:
            break
        if tick not in wanted and result.fall_cause is None:
            continue
        place = {name: plant.data.xpos[plant.model.body(name).id].copy() for chain in LEGS for name in chain}
        chains = [np.array([place[name] for name in chain]) for chain in LEGS]
        chains[1] = np.vstack((chains[1], plant.data.xipos[plant.model.body("trunk").id]))
        feet = plant.feet()
        soles = tuple(
            foot.position_ankle + robot.feet[i].corners_from_ankle.dot(foot.rotation.T) for i, foot in enumerate(feet)
        )
        last = Pose(
            time_s=tick * TIMESTEP_S,
            chains=tuple(chains),
            soles=(soles[0], soles[1]),
            ankle=feet[scenario.support.reference_foot].position_ankle,
            com=plant.position_com(),
            zmp=result.balance.zmp_in_world,
            stones=plant.stones.stones,
        )
        poses.append(last)
        if result.fall_cause is not None:
            break
    return PoseTrack(case, tuple(poses), simulation.fall_time_s)
