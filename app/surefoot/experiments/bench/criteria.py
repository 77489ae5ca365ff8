"""What counts as survived: no fall, and at rest on the stance foot at the end; of a walk, that it is completed."""

import math
from dataclasses import dataclass, replace

import numpy as np

LAST_S = 1.0
COM_ERROR_M = 0.010
COM_SPEED_MPS = 0.02
SWING_FORCE_N = 1e-6  # nothing but rounding dust

OUTCOMES = ("stands", "unsettled", "falls", "refused")


@dataclass(frozen=True)
class Survival:
    """How an episode ended.

    Attributes:
        outcome: ``stands`` (survived), ``unsettled`` (did not fall, but a criterion is not met), ``falls``.
        com_error_m: greatest distance of the CoM from its reference in the last second.
        com_speed_mps: greatest speed of the CoM in the last second.
        swing_force_n: greatest vertical force on the swing foot over the whole episode; 0 in double support, NaN of
            a walk.
    """

    outcome: str
    com_error_m: float
    com_speed_mps: float
    swing_force_n: float


def judge(
    *, fell: bool, time_s: np.ndarray, com_error_m: np.ndarray, com_speed_mps: np.ndarray, swing_force_n: np.ndarray
) -> Survival:
    """Whether an episode was survived.

    Args:
        fell: whether the simulator saw a fall.
        time_s: (n,) of every tick.
        com_error_m: (n,) distance of the CoM from its reference.
        com_speed_mps: (n,) speed of the CoM.
        swing_force_n: (n,) vertical force on the swing foot, zeros in double support.
    """
    last = time_s > time_s[-1] - LAST_S + 1e-9
    error, speed = float(com_error_m[last].max()), float(com_speed_mps[last].max())
    touch = float(np.abs(swing_force_n).max())
    settled = error < COM_ERROR_M and speed < COM_SPEED_MPS and touch < SWING_FORCE_N  # False for NaN
    return Survival("falls" if fell else "stands" if settled else "unsettled", error, speed, touch)


def judge_walk(survival: Survival, *, completed: bool) -> Survival:
    """The same of a walk: all steps made and then stood, wherever the CoM is; feet that swing touch the ground."""
    outcome = survival.outcome if survival.outcome == "falls" else "stands" if completed else "unsettled"
    return replace(survival, outcome=outcome, swing_force_n=math.nan)


def judge_steps(survival: Survival, *, on_its_feet: bool) -> Survival:
    """The same of who steps when needed: at rest on the feet that are to stand, wherever these are."""
    rests = on_its_feet and survival.com_speed_mps < COM_SPEED_MPS
    outcome = survival.outcome if survival.outcome == "falls" else "stands" if rests else "unsettled"
    return replace(survival, outcome=outcome, swing_force_n=math.nan)
