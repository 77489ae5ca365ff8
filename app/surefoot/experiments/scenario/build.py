"""From a scenario and a controller's name to a simulation ready to tick."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from surefoot.control.delta_reference import admissible_intervals
from surefoot.control.interface import Controller
from surefoot.control.registry import ControllerEntry, controller_named
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.heights import solve_start
from surefoot.experiments.scenario.imperfect import UNREAD_SENSORS, imperfections, senses, sensors_are_unread
from surefoot.experiments.scenario.references import (
    build_gait,
    build_reference,
    feet_at_start,
    level_stance_point,
    planned_footsteps,
    start_posture,
)
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.experiments.scenario.timing import rounding_warnings
from surefoot.experiments.scenario.uneven_ground import build_terrain
from surefoot.number_text import figure
from surefoot.robot.description import RobotDescription
from surefoot.simulation.loop import Simulation
from surefoot.simulation.measurement import stones_in_robot
from surefoot.simulation.plant import Plant
from surefoot.simulation.recorder import Recorder
from surefoot.task.posture import Posture, ground_pivot, solve_posture
from surefoot.task.reference import TaskReference


@dataclass(frozen=True, eq=False)
class Setup:
    """A simulation and what was found while building it.

    Attributes:
        simulation: ready to tick.
        warnings: e.g. a joint that the posture or the end of a swing puts outside its range, a value that is rounded.
    """

    simulation: Simulation
    warnings: tuple[str, ...]


def build_controller(entry: ControllerEntry, robot: RobotDescription, scenario: Scenario) -> Controller:
    """The controller with the scenario's settings. Raises InvalidInput, ControllerError."""
    return entry.make(robot, entry.settings(scenario.controller))


def build_simulation(
    scenario: Scenario, controller_name: str, *, rows: int, clock: Callable[[], int] | None = None
) -> Setup:
    """Solve the posture, build the world, place stones and pushes.

    Args:
        scenario: what to simulate.
        controller_name: as in the registry.
        rows: capacity of the recorder.
        clock: optional timing probe for the loop.

    Raises:
        InvalidInput: unknown controller or setting; a lying stone that starts inside a foot.
        ControllerError: the controller cannot be built.
        PostureError: inverse kinematics has no solution for the posture or the end of the swing.
    """
    robot = scenario.robot_description()
    entry = controller_named(controller_name)
    settings = entry.settings(scenario.controller)
    controller = build_controller(entry, robot, scenario)
    dynamics = DynamicsModel(robot)
    posture = start_posture(scenario)
    start = solve_start(scenario, dynamics)
    warnings = (*rounding_warnings(scenario), *_range_warnings("the posture", start))
    reference = build_reference(scenario, settings, dynamics)
    if scenario.reference.kind == "swing":
        end = reference.at(scenario.reference.start_s + scenario.reference.duration_s)
        warnings += _range_warnings("the end of the swing", solve_posture(dynamics, end))
    warnings += bias_warnings(dynamics, posture, settings)

    gait = build_gait(scenario)
    terrain = build_terrain(
        robot,
        feet_at_start(scenario),
        planned_footsteps(scenario),
        tiles=scenario.ground.tiles,
        ledges=scenario.ledges,
        stones=scenario.stones_under_steps,
    )
    pivot = ground_pivot(robot, scenario.support)
    plant = Plant(robot, scenario.physics, scenario.ground, pivot, terrain, imperfections(scenario, robot))
    plant.reset(start.q, drop_height_m=scenario.drop_height_m)
    x, y = level_stance_point(scenario)
    for stone in scenario.stones:
        plant.stones.place(replace(stone, x_m=stone.x_m + x, y_m=stone.y_m + y))
    if any(stone.lying for stone in scenario.stones):
        _refuse_stones_in_feet(plant, scenario)
    known = senses(scenario, robot, plant)
    if sensors_are_unread(scenario):
        warnings += (UNREAD_SENSORS,)
    recorder = Recorder([joint.name for joint in robot.joints], rows, belief=known is not None)
    simulation = Simulation(
        robot,
        plant,
        scenario.support,
        reference,
        controller,
        recorder,
        clock=clock,
        controller_name=entry.name,
        gait=gait,
        senses=known,
    )
    simulation.pushes.extend(scenario.pushes)
    return Setup(simulation, warnings)


def bias_warnings(dynamics: DynamicsModel, posture: TaskReference, settings: ControllerSettings) -> tuple[str, ...]:
    """A line for every component of delta_P^ref outside its admissible interval."""
    values = (settings.delta_ref_frontal_nm, settings.delta_ref_sagittal_nm)
    if not any(values):
        return ()
    intervals = admissible_intervals(dynamics, posture, settings)
    return tuple(
        f"{name} = {value:g} N m is outside its admissible interval "
        f"{figure(interval.low_nm)} to {figure(interval.high_nm)} N m"
        for name, value, interval in zip(
            ("delta_ref_frontal_nm", "delta_ref_sagittal_nm"), values, intervals, strict=True
        )
        if not interval.contains(value)
    )


def _refuse_stones_in_feet(plant: Plant, scenario: Scenario) -> None:
    """A stone that starts inside a foot would fling the robot away. Raises InvalidInput."""
    for i, depth in stones_in_robot(plant).items():
        reason = (
            f"the stone would lie {1e3 * depth:.1f} mm inside a foot at the start; release the robot above it "
            "(drop_height_m) or let it rise"
        )
        raise InvalidInput(f"stones.{i}.height_m", scenario.stones[i].height_m, reason)


def _range_warnings(what: str, posture: Posture) -> tuple[str, ...]:
    return tuple(f"{what} puts {line}" for line in posture.out_of_range)
