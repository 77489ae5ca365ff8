"""How a robot that does not know everything comes to know its state: sensors, then an estimator."""

import math

import numpy as np

from surefoot.errors import EstimatorError, one_line
from surefoot.estimation.com_offset import CoMOffset
from surefoot.estimation.interface import Estimate, Estimator
from surefoot.estimation.prediction import Prediction
from surefoot.robot.description import RobotState
from surefoot.simulation.plant import Plant
from surefoot.simulation.sensors.suite import Sensors


class Senses:
    """Reads the sensors of a plant and asks an estimator, once in every tick.

    An estimator may be someone else's code, so that whatever goes wrong in it is told by its name.

    Args:
        sensors: what they add to the truth.
        estimator: already told where the robot starts.
        name: what people call the estimator.
        prediction: carries what is believed forward; None: it stays as old as the readings are.
        com_offset: finds how far the believed CoM is off; None: nobody does.
    """

    def __init__(
        self,
        sensors: Sensors,
        estimator: Estimator,
        name: str,
        *,
        prediction: Prediction | None = None,
        com_offset: CoMOffset | None = None,
    ):
        self._sensors, self._estimator, self._prediction, self.name = sensors, estimator, prediction, name
        self.com_offset = com_offset

    def estimate(self, plant: Plant) -> Estimate:
        """What is believed now. Raises EstimatorError: the estimator failed, or gave what is no number."""
        readings = self._sensors.read(plant.signals(), plant.time_s)
        try:
            estimate = self._estimator.tick(readings)
            state = estimate.state
            parts = (state.q, state.v, estimate.sensing.wrenches.ravel(), np.diagonal(estimate.covariance))
            finite = math.isfinite(sum(float(part.dot(part)) for part in parts))
        except (Exception, SystemExit) as error:
            raise EstimatorError(self.name, f"cannot estimate ({one_line(error)})") from error
        if not finite:
            raise EstimatorError(self.name, "gave what is no number")
        if self._prediction is not None:
            state = self._prediction.ahead(state)
        return Estimate(RobotState(state.q, state.v, plant.time_s), estimate.sensing, estimate.covariance)
