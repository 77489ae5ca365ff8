"""What a scenario says of sensors, estimator, motors and errors of the model, as parts of a simulation."""

from dataclasses import replace

import numpy as np

from surefoot.errors import EstimatorError, SurefootError, one_line
from surefoot.estimation.com_offset import CoMOffset
from surefoot.estimation.prediction import Prediction
from surefoot.estimation.registry import TRUTH, estimator_named
from surefoot.estimation.settings import EstimatorSettings
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.geometry.rotations import quaternion_xyzw, rotation_from_xyzw, turn_by
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.simulation.imperfections import Imperfections
from surefoot.simulation.plant import Plant
from surefoot.simulation.senses import Senses
from surefoot.simulation.sensors.settings import SensorSettings
from surefoot.simulation.sensors.suite import Sensors, imu_mount, sensor_noise

UNREAD_SENSORS = 'sensors: nobody reads them with estimator.kind = "truth", the controller gets the true state'


def imperfections(scenario: Scenario, robot: RobotDescription) -> Imperfections:
    """What the plant is built with; an IMU only if somebody reads it, so that without one it is the plant as ever."""
    imu = None if scenario.estimator.kind == TRUTH else imu_mount(robot, scenario.sensors)
    return Imperfections(imu=imu, motors=scenario.motors, model_error=scenario.model_error)


def sensors_are_unread(scenario: Scenario) -> bool:
    """Whether sensors with errors are asked for, or something of an estimator, and no estimator that reads them."""
    errors = replace(scenario.sensors, preset=SensorSettings.preset, seed=SensorSettings.seed)
    asked = errors != SensorSettings(imu_body=errors.imu_body) or scenario.estimator != EstimatorSettings()
    return scenario.estimator.kind == TRUTH and asked


def senses(scenario: Scenario, robot: RobotDescription, plant: Plant) -> Senses | None:
    """Sensors and estimator, told where the robot stands now; None where the controller gets the true state.

    Raises:
        EstimatorError: the estimator cannot be built, or cannot start there.
    """
    entry, settings = estimator_named(scenario.estimator.kind), scenario.sensors
    if entry.build is None:
        return None
    try:
        estimator = entry.build(robot, imu_mount(robot, settings), sensor_noise(settings))
        estimator.reset(_told(plant.sense()[0], scenario))
    except SurefootError:
        raise
    except (Exception, SystemExit) as error:  # it may be someone else's code
        raise EstimatorError(entry.name, f"cannot be built ({one_line(error)})") from error
    late = scenario.estimator.predict and max(settings.imu_latency_s, settings.encoder_latency_s) > 0.0
    prediction = Prediction(settings.imu_latency_s, settings.encoder_latency_s) if late else None
    rate = scenario.estimator.com_offset_rate
    return Senses(
        Sensors(settings, len(robot.joints)),
        estimator,
        entry.name,
        prediction=prediction,
        com_offset=CoMOffset(robot, rate) if rate else None,
    )


def _told(state: RobotState, scenario: Scenario) -> RobotState:
    """What an estimator is told of the start: the truth, with its base tilted about its origin."""
    if scenario.estimator.told_tilt_rad == 0.0:
        return state
    x, y = scenario.estimator.told_tilt_rad * np.random.default_rng((scenario.sensors.seed, 4)).standard_normal(2)
    q = state.q.copy()
    q[3:7] = quaternion_xyzw(turn_by(np.array((x, y, 0.0))).dot(rotation_from_xyzw(q[3:7])))
    return RobotState(q, state.v, state.time_s)
