"""The way of the ZMP that goes with footsteps: it rests in the foot that stands, and crosses while both do."""

from collections.abc import Sequence

import numpy as np

from surefoot.gait.dcm_plan import ZMPPiece
from surefoot.gait.footsteps import Footstep, StepTiming
from surefoot.gait.scale import BIP, GaitScale
from surefoot.geometry.polygon import ConvexPolygon, project_onto_halfplanes

REST_FORWARD_M = 0.02  # of the ankle: near the middle of the sole
BRAKE_MARGIN_M = 0.02  # from the sole's edge; found by trial down a ledge of 60 mm, not searched for further


def rest_in(foot: Footstep, scale: GaitScale = BIP) -> np.ndarray:
    """Where the ZMP rests while a foot stands alone (2,) in world [m]."""
    return foot.point + REST_FORWARD_M * scale.sole_middle * foot.axes[:, 0]


def braking_zmp(foot: Footstep, sole: ConvexPolygon, capture: np.ndarray, scale: GaitScale = BIP) -> np.ndarray:
    """Where in a sole the ZMP brakes a capture point most: it comes nearest to it there.

    Args:
        foot: that stands alone.
        sole: its outline, as ``Foot.sole``.
        capture: capture point (2,) in world [m].
        scale: of the robot.

    Returns:
        (2,) in world [m].
    """
    here = (capture - foot.point).dot(foot.axes)
    nearest = project_onto_halfplanes(here, sole.normals, sole.offsets - BRAKE_MARGIN_M * scale.sole)
    return foot.point + foot.axes.dot(sole.centroid if nearest is None else nearest)


def zmp_ahead(here: Footstep, ahead: Sequence[Footstep], timing: StepTiming, scale: GaitScale = BIP) -> list[ZMPPiece]:
    """The ZMP from the moment when a foot begins to stand alone.

    Args:
        here: that foot.
        ahead: the steps to come, at least one; after the last the ZMP comes to rest between both feet.
        timing: of the steps.
        scale: of the robot.
    """
    pieces, place = [], rest_in(here, scale)
    for step in ahead:
        there = rest_in(step, scale)
        pieces += [ZMPPiece(place, place, timing.single_s), ZMPPiece(place, there, timing.double_s)]
        place = there
    last = pieces[-1]
    pieces[-1] = ZMPPiece(last.start, 0.5 * (last.start + last.end), last.duration_s)
    return pieces
