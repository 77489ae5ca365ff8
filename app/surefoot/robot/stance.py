"""How one robot stands on one support, where the rule that all others stand by does not do for it."""

import numpy as np

from surefoot.record import record


@record
class Stance:
    """The parts of kappa in a standing posture, soles level; world axes as in ``task.posture.standing_reference``.

    Attributes:
        position_com: G (3,) [m].
        rotation_base_to_world: (3, 3).
        position_ankles: left, right, (3,) each [m].
        upper_rad: angles of the joints that are in no leg.
    """

    position_com: np.ndarray
    rotation_base_to_world: np.ndarray
    position_ankles: tuple[np.ndarray, np.ndarray]
    upper_rad: np.ndarray
