"""All that sets a plant apart from the robot that its controller knows, beside ``PhysicsSettings``."""

from dataclasses import dataclass, field

from surefoot.robot.sensing import ImuMount
from surefoot.simulation.model_error import ModelErrorSettings
from surefoot.simulation.motors import MotorSettings


@dataclass(frozen=True, eq=False, kw_only=True)
class Imperfections:
    """What a plant is built with; none of it is ever changed while it runs.

    Attributes:
        imu: where an IMU sits; None: there is none, nobody reads it.
        motors: how good the motors are.
        model_error: how far the robot is from its nominal model.
    """

    imu: ImuMount | None = None
    motors: MotorSettings = field(default_factory=MotorSettings)
    model_error: ModelErrorSettings = field(default_factory=ModelErrorSettings)


PERFECT_PLANT = Imperfections()
