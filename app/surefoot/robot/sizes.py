"""How large a robot is compared with Bip, on which every length and force of the program was tried out."""

from collections.abc import Sequence

import numpy as np

from surefoot.record import record
from surefoot.robot.feet import Foot
from surefoot.robot.pinocchio_library import pin

# Bip's own, so that all of its ratios are exactly 1
_MASS_KG = 104.81
LEG_M = 0.82  # from hip to ankle, joint by joint
_STRAIGHT_COM_M, _STRAIGHT_BASE_M = 1.011, 0.903  # above the soles, every joint at 0
_BENT = 0.9644  # of those heights with the knees bent as Bip stands
_SOLE_M = (0.29, 0.18)  # from heel to toe and across
_START_M = 0.02  # what a start for Newton's method is rounded to


@record
class Sizes:
    """Ratios to Bip, and two lengths.

    Attributes:
        weight: of the masses: forces scale with it.
        leg: of the legs' lengths, summed from joint to joint.
        com_height: of the heights of G in the standing posture.
        base_height: of the heights of the base there.
        sole_length, sole_width: of the soles' extents from heel to toe and across.
        foot_spread_m: half the distance between the ankles across the heading, in that posture.
        base_below_com_m: height of G above the base there, to 20 mm.
    """

    weight: float
    leg: float
    com_height: float
    base_height: float
    sole_length: float
    sole_width: float
    foot_spread_m: float
    base_below_com_m: float


def measure(model: pin.Model, feet: Sequence[Foot], angles: np.ndarray | None) -> Sizes:
    """The sizes of a robot.

    Args:
        model: the robot's.
        feet: left, right.
        angles: of all joints in a nominal standing posture, base level (joints,) [rad]; None: they are measured with
            every joint at 0, which is to be straight legs, and the knees are bent as Bip's are.
    """
    data, q = model.createData(), pin.neutral(model)
    if angles is not None:
        q[7:] = angles
    pin.framesForwardKinematics(model, data, q)
    com = pin.centerOfMass(model, data, q)[2]
    ankles = []
    for foot in feet:
        link = data.oMf[model.getFrameId(foot.body)]
        ankles.append(link.act(foot.ankle_in_body))
    sole = float(np.mean([ankle[2] - foot.ankle_height_m for ankle, foot in zip(ankles, feet, strict=True)]))
    bent = 1.0 if angles is None else _BENT
    leg = sum(float(np.linalg.norm(model.jointPlacements[joint].translation)) for joint in _below_hip(model, feet[0]))
    length, width = np.ptp(feet[0].sole.vertices, axis=0).tolist()
    return Sizes(
        weight=round(float(data.mass[0]), 2) / _MASS_KG,
        leg=round(leg, 3) / LEG_M,
        com_height=round(float(com) - sole, 3) / (bent * _STRAIGHT_COM_M),
        base_height=round(-sole, 3) / (bent * _STRAIGHT_BASE_M),
        sole_length=round(length, 4) / _SOLE_M[0],
        sole_width=round(width, 4) / _SOLE_M[1],
        foot_spread_m=round(0.5 * float(abs(ankles[0][1] - ankles[1][1])), 3),
        base_below_com_m=_START_M * round(float(com) / _START_M),
    )


def _below_hip(model: pin.Model, foot: Foot) -> list[int]:
    """Joints of a leg but its first."""
    return [joint for joint in range(model.njoints) if model.joints[joint].idx_v in foot.leg[1:]]
