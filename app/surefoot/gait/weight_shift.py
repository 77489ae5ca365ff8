"""How long the weight shifts from one foot to the next: so long that the plan begins where the capture point is."""

import math
from collections.abc import Sequence

import numpy as np

from surefoot.gait.dcm_plan import DCMPlan, ZMPPiece
from surefoot.gait.scale import BIP, GaitScale

LONGEST_S = 0.45  # found by trial, with a 20 mm stone under each step
_TRIED = 16  # durations, evenly from the shortest to the longest
_NEARER_M = 1e-4  # a longer one has to be so much better


def shift_duration(
    zmp: np.ndarray,
    then: Sequence[ZMPPiece],
    capture: np.ndarray,
    omega: float,
    shortest_s: float,
    scale: GaitScale = BIP,
) -> float:
    """Time on two feet [s] after which the next foot is lifted.

    A foot that landed early, or beside its place, leaves the capture point elsewhere than planned. With more time on
    two feet the plan begins further back: it is given as much as brings its beginning nearest to the capture point.

    Args:
        zmp: where it is (2,) in world [m].
        then: its way from the moment on when one foot stands alone; the shift ends where this begins.
        capture: capture point (2,) in world [m].
        omega: natural frequency [rad/s].
        shortest_s: as planned [s].
        scale: of the robot.
    """
    there, best, nearest = then[0].start, shortest_s, math.inf
    end = DCMPlan(list(then), omega).at(0.0)[1]
    for duration in np.linspace(shortest_s, max(shortest_s, LONGEST_S * scale.time), _TRIED).tolist():
        ahead = (there - zmp) / (duration * omega)
        begins = zmp + ahead + math.exp(-omega * duration) * (end - there - ahead)
        off = math.hypot(*(begins - capture))
        if off < nearest - _NEARER_M:
            best, nearest = duration, off
    return best
