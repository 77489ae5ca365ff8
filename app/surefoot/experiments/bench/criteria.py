"""What counts as survived: no fall, and at rest on the stance foot at the end; of a walk, that it is completed."""

import math
from dataclasses import dataclass, replace

import numpy as np

from surefoot.experiments.runs.walk_tally import STANDS_S

LAST_S = 1.0
# A robot that does not know everything stands for so long first (twice what ``anchor`` takes to find the biases of its
# IMU), and where it stood at the end of that is where it has to come back to
WARM_UP_S, STOOD_S = 2.0, 0.5
COM_ERROR_M = 0.010
COM_SPEED_MPS = 0.02
SWING_FORCE_N = 1e-6  # nothing but rounding dust

OUTCOMES = ("stands", "unsettled", "falls", "refused")


@dataclass(frozen=True)
class Survival:
    """How an episode ended.

    Attributes:
        outcome: ``stands`` (survived), ``unsettled`` (did not fall, but a criterion is not met), ``falls``.
        com_error_m: greatest distance of the CoM from where it should be in the last second.
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
        com_error_m: (n,) distance of the CoM from its reference, or from where it stood: see ``stood_off``.
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


def survived_means(*, walks: bool, knows_all: bool) -> dict[str, str]:
    """What surviving means, for manifests.

    Args:
        walks: some of the cases are walks.
        knows_all: no controller believes anything that is not so.
    """
    meant = {
        "no fall, and in the last": f"{LAST_S} s",
        "CoM error below": f"{COM_ERROR_M} m",
        "CoM speed below": f"{COM_SPEED_MPS} m/s",
        "swing-foot force": "zero throughout (single support)",
    }
    if not knows_all:
        meant["CoM error with an estimator or errors of the model"] = (
            f"from where it stood in the {STOOD_S:g} s before the disturbance, which then comes {WARM_UP_S:g} s later"
        )
    return {**meant, **({"in a walk instead": f"all steps made, then {STANDS_S} s stood"} if walks else {})}


def stood_off(time_s: np.ndarray, off: np.ndarray, onset_s: float | None) -> np.ndarray | None:
    """Where a robot stood before it was disturbed, seen from where its CoM should be (3,) [m].

    A robot with longer legs, or a heavier trunk, than it knows of stands somewhere else than it wants to, and cannot
    know. What it can do is come back to where it stood.

    Args:
        time_s: (n,) of every tick.
        off: (n, 3) CoM less its reference, world [m].
        onset_s: when the disturbance begins; None for none.

    Returns:
        The mean over ``STOOD_S`` before the onset; None where it did not stand for so long.
    """
    if onset_s is None or onset_s < STOOD_S:
        return None
    before = (time_s > onset_s - STOOD_S) & (time_s < onset_s)
    return off[before].mean(axis=0) if before.any() else None
