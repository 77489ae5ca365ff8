"""Which estimator a scenario asks for."""

import dataclasses
from dataclasses import dataclass

from surefoot.estimation.registry import TRUTH, estimator_named


@dataclass(frozen=True, kw_only=True)
class EstimatorSettings:
    """How the controller comes to know the state. Validated at creation (InvalidInput).

    Attributes:
        kind: name in the registry.
    """

    kind: str = dataclasses.field(
        default=TRUTH, metadata={"help": "truth, or an estimator that reads the sensors: see surefoot settings"}
    )

    def __post_init__(self) -> None:
        """Refuse what no estimator is called."""
        estimator_named(self.kind)
