"""How wrong an estimator was over a run, for its summary."""

import math
from array import array
from typing import Any

import numpy as np

from surefoot.simulation.belief import Belief


class BeliefTally:
    """Sizes of the errors of every tick, and the last belief."""

    def __init__(self) -> None:
        self._dcm, self._tilt = array("d"), array("d")
        self._last: Belief | None = None

    def add(self, belief: Belief | None) -> None:
        """Take one tick; None where nobody believes anything."""
        if belief is None:
            return
        self._dcm.append(math.hypot(*belief.dcm_error.tolist()))
        self._tilt.append(math.hypot(*belief.orientation_error[:2].tolist()))
        self._last = belief

    def summary(self) -> dict[str, Any]:
        """Percentiles over all ticks, and how far it had drifted at the end; empty without a tick.

        Returns:
            ``dcm_error_p50_mm``, ``dcm_error_p99_mm``: distance of the believed from the true DCM, seen from the feet.
            ``tilt_error_p99_deg``: angle about a horizontal axis.
            ``position_drift_mm``, ``yaw_drift_deg``: horizontal error of the base's position, and of its heading, in
            the last tick: nothing observes them.
        """
        if self._last is None:
            return {}
        return {
            "dcm_error_p50_mm": 1e3 * float(np.percentile(self._dcm, 50.0)),
            "dcm_error_p99_mm": 1e3 * float(np.percentile(self._dcm, 99.0)),
            "tilt_error_p99_deg": math.degrees(float(np.percentile(self._tilt, 99.0))),
            "position_drift_mm": 1e3 * math.hypot(*self._last.position_error[:2].tolist()),
            "yaw_drift_deg": math.degrees(float(self._last.orientation_error[2])),
        }
