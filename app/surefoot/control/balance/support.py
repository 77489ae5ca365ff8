"""The support as the controller sees it: planned contacts, how loaded each is, one frame and one polygon."""

from functools import lru_cache

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.geometry.rotations import heading
from surefoot.geometry.smooth_step import smooth_step
from surefoot.record import record
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing

_LOADED_AT = 0.05  # share of the weight from which a foot in double support counts as fully loaded


@record
class SupportGeometry:
    """Where the robot may push on the ground.

    Attributes:
        stance: indices of the feet in contact (0 left, 1 right).
        loads: for each foot how far it counts as loaded, 0 to 1.
        points: P of both feet: the point of the sole plane below the ankle (3,) in world [m].
        origin: origin of the support frame (3,) in world [m]: P, or midway between both P.
        axes: (2, 2) support frame -> horizontal world axes.
        polygon: true support polygon in that frame.
    """

    stance: tuple[int, ...]
    loads: tuple[float, float]
    points: tuple[np.ndarray, np.ndarray]
    origin: np.ndarray
    axes: np.ndarray
    polygon: ConvexPolygon

    def to_world(self, point: np.ndarray) -> np.ndarray:
        """Support frame (2,) -> world (2,) [m]."""
        return self.origin[:2] + self.axes.dot(point)

    def from_world(self, point: np.ndarray) -> np.ndarray:
        """World (2,) -> support frame (2,) [m]."""
        return (point - self.origin[:2]).dot(self.axes)


_IDENTITY = np.eye(2)


def support_geometry(
    robot: RobotDescription, terms: DynamicsTerms, support: Support, sensing: FootSensing
) -> SupportGeometry:
    """The support frame and polygon now.

    Single support: the stance foot's heading frame at P. Double support: world axes midway between both P, the convex
    hull of both soles, and a load factor for each foot that falls smoothly to zero as its sensed force does.
    """
    (left_foot, right_foot), (left, right) = robot.feet, terms.feet
    left = left_foot.point_below(left.position_ankle_in_world, left.rotation_foot_to_world)
    right = right_foot.point_below(right.position_ankle_in_world, right.rotation_foot_to_world)
    if support is not Support.DOUBLE:
        i = support.reference_foot
        axes = heading(terms.feet[i].rotation_foot_to_world)
        loads = (1.0, 0.0) if i == 0 else (0.0, 1.0)
        return SupportGeometry((i,), loads, (left, right), (left, right)[i], axes, robot.feet[i].sole)
    origin = 0.5 * (left + right)
    corners = [
        terms.feet[i].position_ankle_in_world + foot.corners_from_ankle.dot(terms.feet[i].rotation_foot_to_world.T)
        for i, foot in enumerate(robot.feet)
    ]
    polygon = convex_hull(((np.vstack(corners) - origin)[:, :2]).tolist())
    full = _LOADED_AT * terms.mass_kg * terms.gravity
    loads = tuple(smooth_step(force / full) for force in sensing.normal_forces)
    if max(loads) == 0.0:  # in the air: act as planned, the ground will come
        loads = (1.0, 1.0)
    return SupportGeometry((0, 1), (loads[0], loads[1]), (left, right), origin, _IDENTITY, polygon)


@lru_cache(maxsize=64)
def grasp_map(robot: RobotDescription, foot: int, scale: float) -> np.ndarray:
    """(6, 3 n) forces at the n sole corners -> wrench about the ankle centre, all in foot axes.

    The corners are scaled about the sole's centroid: below 1 they keep the ZMP away from the edge, above 1 they become
    virtual points outside a sole that is no longer flat on the ground.
    """
    corners = robot.feet[foot].corners_from_ankle.copy()
    centre = robot.feet[foot].sole.centroid
    corners[:, :2] = centre + scale * (corners[:, :2] - centre)
    blocks = []
    for x, y, z in corners:
        blocks.append(np.vstack((np.eye(3), [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])))
    return np.hstack(blocks)


@lru_cache(maxsize=64)
def friction_rows(corners: int, friction: float) -> np.ndarray:
    """(4 n, 3 n) rows of the inner friction pyramid, row @ forces <= 0: |f_x|, |f_y| <= mu f_z, hence f_z >= 0."""
    one = np.array(((1.0, 0.0, -friction), (-1.0, 0.0, -friction), (0.0, 1.0, -friction), (0.0, -1.0, -friction)))
    return np.kron(np.eye(corners), one)
