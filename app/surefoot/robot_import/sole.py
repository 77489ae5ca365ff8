"""The sole of a foot: the hull of the lowest points of its collision shapes, in the plane that they stand on."""

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from surefoot.geometry.polygon import ConvexPolygon
from surefoot.record import record
from surefoot.robot.feet import sole_from_points
from surefoot.robot_import.ankles import Ankle
from surefoot.robot_import.foot_points import collision_geoms, foot_points
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.problem import RefusedError

THICKNESS_M = 0.02  # of the convex mesh that stands for the sole
_STEEPEST_DEG = 45.0  # of the sole in the posture
_MOST_CORNERS = 12
_ROUNDS = 5
_REMEDY = "give the foot a collision shape, or say its corners in robot.toml: [feet.left] corners = [[x, y, z], ...]"


@record
class Sole:
    """A sole, in the foot frame: origin at the ankle's centre, x forward along the sole, z along its normal.

    Attributes:
        rotation_in_body: (3, 3) foot frame -> frame of the foot's body.
        ankle_in_body: (3,) the ankle's centre in the frame of the foot's body [m].
        ankle_height_m: of the ankle's centre above the sole.
        outline: corners (n, 2) relative to the point below the ankle.
        how: what it was made from.
        tilt_deg: of the sole from the base's xy plane, in the posture.
        area_lost: share of the hull's area that the outline leaves out to have few corners.
    """

    rotation_in_body: np.ndarray
    ankle_in_body: np.ndarray
    ankle_height_m: float
    outline: ConvexPolygon
    how: str
    tilt_deg: float
    area_lost: float

    @property
    def length_m(self) -> float:
        """Along x."""
        return float(np.ptp(self.outline.vertices[:, 0]))

    @property
    def width_m(self) -> float:
        """Along y."""
        return float(np.ptp(self.outline.vertices[:, 1]))

    def mesh_in_body(self) -> np.ndarray:
        """(2 n, 3) corners of a plate on the sole, in the frame of the foot's body [m]."""
        bottom = np.column_stack((self.outline.vertices, np.full(len(self.outline.vertices), -self.ankle_height_m)))
        top = bottom + np.array((0.0, 0.0, min(THICKNESS_M, 0.5 * self.ankle_height_m)))
        return np.vstack((bottom, top)) @ self.rotation_in_body.T + self.ankle_in_body


def find_sole(tree: KinematicTree, body: int, ankle: Ankle, corners: np.ndarray | None) -> Sole:
    """The sole of a foot.

    Args:
        tree: the robot in its posture.
        body: index of the foot's body.
        ankle: of that foot.
        corners: (n, 3) in the frame of the body, if robot.toml has them [m].

    Raises:
        RefusedError: no shape makes a sole.
    """
    base, rotation = tree.rotation(tree.base), tree.rotation(body)
    name = tree.body_name(body)
    if corners is not None:
        points, how = tree.position(body) + corners @ rotation.T, "corners in robot.toml"
        normal = _plane(points, base[:, 2], name)
    else:
        geoms, how = collision_geoms(tree, body)
        if not geoms:
            raise RefusedError("sole", f"{name} has no collision shape", _REMEDY)
        normal = base[:, 2]
        for _ in range(_ROUNDS):  # where a round shape reaches lowest depends on the plane
            points = foot_points(tree, geoms, -normal)
            turned = _plane(points, base[:, 2], name)
            turned, normal = normal, turned
            if np.dot(turned, normal) > 1.0 - 1e-12:
                break
        points = foot_points(tree, geoms, -normal)
    foot = np.column_stack((*_axes(tree, ankle, normal, base), normal))
    try:
        hull, from_ankle = sole_from_points((points - ankle.centre_in_world) @ foot)
    except ValueError:
        raise RefusedError("sole", f"the lowest points of {name} span no area", _REMEDY) from None
    height = float(-from_ankle[0, 2])
    if height <= 0.0:
        raise RefusedError("sole", f"the ankle of {name} lies {-1e3 * height:.0f} mm below its sole", _REMEDY)
    outline = _few_corners(hull)
    return Sole(
        rotation_in_body=rotation.T @ foot,
        ankle_in_body=rotation.T @ (ankle.centre_in_world - tree.position(body)),
        ankle_height_m=height,
        outline=outline,
        how=how,
        tilt_deg=float(np.degrees(np.arccos(np.clip(np.dot(normal, base[:, 2]), -1.0, 1.0)))),
        area_lost=1.0 - _area(outline.vertices) / _area(hull.vertices),
    )


def _axes(tree: KinematicTree, ankle: Ankle, normal: np.ndarray, base: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """x and y of the foot: from the axis that is fixed in the foot, laid into the plane of the sole."""
    axis = tree.axis(ankle.lower)
    if ankle.lower == ankle.roll:
        x = axis - np.dot(axis, normal) * normal
    else:
        x = np.cross(axis, normal)
    x /= np.linalg.norm(x)
    x *= np.sign(np.dot(x, base[:, 0])) or 1.0
    return x, np.cross(normal, x)


def _plane(points: np.ndarray, up: np.ndarray, name: str) -> np.ndarray:
    """Upward normal (3,) of the largest facet of the hull that looks down: its plane, not that of the posture."""
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return _flat_plane(points, up, name)
    corners = points[hull.simplices]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    outward = hull.equations[:, :3]
    down = outward @ -up > np.cos(np.radians(_STEEPEST_DEG))
    if not down.any():
        raise RefusedError("sole", f"no facet of {name} looks down in the posture", _REMEDY)
    # triangles of one facet share a plane up to rounding, and add up
    same = outward @ outward.T > 1.0 - 1e-6
    facet = np.where(down, same @ (areas * down), -1.0).argmax()
    return -outward[facet] / np.linalg.norm(outward[facet])


def _flat_plane(points: np.ndarray, up: np.ndarray, name: str) -> np.ndarray:
    """Upward normal of points that lie in one plane, as four spheres of one size do."""
    centred = points - points.mean(axis=0)
    _, spread, axes = np.linalg.svd(centred, full_matrices=True)
    normal = axes[2] * (np.sign(np.dot(axes[2], up)) or 1.0)
    if len(points) < 3 or spread[1] < 1e-4 or np.dot(normal, up) < np.cos(np.radians(_STEEPEST_DEG)):
        raise RefusedError("sole", f"the {len(points)} points of {name} span no sole", _REMEDY)
    return normal


def _few_corners(hull: ConvexPolygon) -> ConvexPolygon:
    """The hull without the corners that matter least to its area: a contact row for each costs time."""
    vertices = hull.vertices
    while len(vertices) > _MOST_CORNERS:
        lost = [
            _area(np.array((vertices[i - 1], vertices[i], vertices[(i + 1) % len(vertices)])))
            for i in range(len(vertices))
        ]
        vertices = np.delete(vertices, int(np.argmin(lost)), axis=0)
    return ConvexPolygon(vertices) if len(vertices) < len(hull.vertices) else hull


def _area(vertices: np.ndarray) -> float:
    x, y = vertices.T
    return 0.5 * abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))
