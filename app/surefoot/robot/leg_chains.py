"""Which joints make the legs, and which of them the ankles: found from the chains of joints, not from names."""

import math
from collections.abc import Sequence

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.robot.pinocchio_library import pin

LEG_JOINTS = 6


def apart(left: Sequence[int], right: Sequence[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """The legs, of two chains of joints from base to feet: what each does not share with the other, in its order.

    A joint above both feet, such as the waist of a robot whose free body is its trunk, is in no leg.
    """
    both = set(left) & set(right)
    one, other = (tuple(joint for joint in chain if joint not in both) for chain in (left, right))
    return one, other


def leg_joints(model: pin.Model, left: str, right: str) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Velocity indices of the joints of both legs, down to the feet: what is ``apart`` of the chains.

    Args:
        model: with a free-flyer root.
        left: link of the left foot.
        right: link of the right foot.

    Raises:
        InvalidInput: a leg has not six joints: H would not be square.
    """
    chains = [sorted(model.supports[model.frames[model.getFrameId(body)].parentJoint]) for body in (left, right)]
    legs = apart(*chains)
    for body, leg in zip((left, right), legs, strict=True):
        if len(leg) != LEG_JOINTS:
            raise InvalidInput("leg", body, f"the leg that ends in it has {len(leg)} joints", [LEG_JOINTS])
    one, other = (tuple(model.joints[joint].idx_v for joint in leg) for leg in legs)
    return one, other


def lateral_axes(model: pin.Model, dofs: tuple[int, ...], body: str, rotation: np.ndarray) -> list[float]:
    """How far the axes of some joints point along a foot's y, from -1 to 1, where every joint is 0.

    Args:
        model: the robot's.
        dofs: velocity indices of joints between base and foot.
        body: link of the foot.
        rotation: foot frame -> link frame (3, 3).
    """
    data = model.createData()
    pin.computeJointJacobians(model, data, pin.neutral(model))
    frame = model.getFrameId(body)
    pin.updateFramePlacement(model, data, frame)
    angular = pin.getFrameJacobian(model, data, frame, pin.LOCAL)[3:]
    return [float(rotation[:, 1].dot(angular[:, dof])) for dof in dofs]


def ankle_joints(model: pin.Model, leg: tuple[int, ...], body: str, rotation: np.ndarray) -> tuple[int, int]:
    """Velocity indices of the pitch (sagittal) and the roll (frontal) joint of an ankle: the last two of the leg.

    The one whose axis is nearer to the foot's y is the pitch joint, whatever its sign and its place in the order.

    Args:
        model: the robot's.
        leg: velocity indices of its joints.
        body: link of the foot.
        rotation: foot frame -> link frame (3, 3).
    """
    one, other = leg[-2:]
    first, second = (abs(value) for value in lateral_axes(model, (one, other), body, rotation))
    return (one, other) if first > second else (other, one)


_BENT_RAD = (-0.3, 0.6, -0.3)  # hip, knee, ankle about an axis to the left: thigh forward, knee bent, sole level
_PITCH = 0.9  # of an axis along the foot's y: a pitch joint


def bent_leg(model: pin.Model, leg: tuple[int, ...], body: str, rotation: np.ndarray) -> dict[int, float]:
    """Velocity index -> angle [rad] of a leg's three pitch joints with the knee bent; empty where it has not three.

    Arguments: as of ``ankle_joints``.
    """
    pitch = [
        (dof, value)
        for dof, value in zip(leg, lateral_axes(model, leg, body, rotation), strict=True)
        if abs(value) > _PITCH
    ]
    if len(pitch) != len(_BENT_RAD):
        return {}
    return {dof: math.copysign(1.0, value) * bent for (dof, value), bent in zip(pitch, _BENT_RAD, strict=True)}
