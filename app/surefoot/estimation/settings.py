"""Which estimator a scenario asks for."""

import dataclasses
from dataclasses import dataclass

from surefoot.estimation.registry import TRUTH, estimator_named
from surefoot.field_metadata import check_fields, number, switch


@dataclass(frozen=True, kw_only=True)
class EstimatorSettings:
    """How the controller comes to know the state. Validated at creation (InvalidInput).

    Attributes:
        kind: name in the registry.
        predict: see ``Prediction``.
        told_tilt_rad: standard deviation of each horizontal axis; drawn by the sensors' seed.
        com_offset_rate: of the observer of how far the CoM is from where it is believed [1/s]; see ``CoMOffset``.
    """

    kind: str = dataclasses.field(
        default=TRUTH, metadata={"help": "truth, or an estimator that reads the sensors: see surefoot settings"}
    )
    predict: bool = switch(False, "carry the belief forward over the latency of IMU and encoders")
    told_tilt_rad: float = number(
        0.0, 0.0, 0.05, "rad", "error of the tilt that the estimator is told at the start, each axis", step=0.001
    )
    com_offset_rate: float = number(
        0.0, 0.0, 5.0, "1/s", "how fast an offset of the believed CoM is found from the foot forces; 0: not at all"
    )

    def __post_init__(self) -> None:
        """Refuse what no estimator is called, NaN, wrong types and values out of range."""
        estimator_named(self.kind)
        check_fields(self, "estimator")
