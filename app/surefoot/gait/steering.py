"""The steps with which a walk goes on when it is steered."""

from collections.abc import Sequence

import numpy as np

from surefoot.gait.footsteps import Footstep, Pace, plan_footsteps


def footsteps_from(step: Footstep, pace: Pace, steps: int) -> list[Footstep]:
    """Even steps after one of them, as ``plan_footsteps`` would have gone on from it.

    Args:
        step: the foot that stands first.
        pace: of the steps.
        steps: how many, the closing one included; a single one sets the feet beside each other where it stands.
    """
    across = pace.width_m if step.foot == 1 else -pace.width_m
    beside = Footstep(1 - step.foot, step.point + across * step.axes[:, 1], step.yaw_rad)
    if steps == 1:
        return [beside]
    left, right = (beside, step) if step.foot == 1 else (step, beside)
    return plan_footsteps(
        (left, right),
        steps=steps,
        length_m=pace.length_m,
        width_m=pace.width_m,
        turn_rad=pace.turn_rad,
        first_foot=beside.foot,
    )


def first_stance(ankles: Sequence[np.ndarray], yaw_rad: float, foot: int, pace: Pace) -> Footstep:
    """The foot that stands while the first step is made, so far aside from the middle as even steps have it.

    Args:
        ankles: both ankle centres where the robot stands at the start (3,) in world [m].
        yaw_rad: heading there.
        foot: which one.
        pace: of the steps.
    """
    middle = Footstep(foot, 0.5 * (ankles[0] + ankles[1])[:2], yaw_rad)
    aside = 0.5 * pace.width_m if foot == 0 else -0.5 * pace.width_m
    return Footstep(foot, middle.point + aside * middle.axes[:, 1], yaw_rad)
