"""Rotation matrices (exponential, logarithm, roll-pitch-yaw, heading) and cross products. Angles in rad."""

import math

import numpy as np


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Vector product a x b of two (3,) vectors."""
    ax, ay, az = a.tolist()
    bx, by, bz = b.tolist()
    return np.array((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))


def skew(a: np.ndarray) -> np.ndarray:
    """The (3, 3) matrix with ``skew(a) @ b == cross(a, b)``."""
    x, y, z = a.tolist()
    return np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))


_SMALL_ANGLE = 1e-6


def rotation_from_vector(vector: np.ndarray) -> np.ndarray:
    """Rotation (3, 3) by |vector| [rad] about the axis of the rotation vector (3,) (Rodrigues)."""
    angle = math.sqrt(float(vector @ vector))
    K = skew(vector)
    if angle < _SMALL_ANGLE:
        return np.eye(3) + K + 0.5 * K @ K
    return np.eye(3) + (math.sin(angle) / angle) * K + ((1.0 - math.cos(angle)) / angle**2) * (K @ K)


def rotation_vector(rotation: np.ndarray) -> np.ndarray:
    """Rotation vector (3,) [rad] of a rotation matrix (3, 3); the inverse of ``rotation_from_vector`` below pi."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation.tolist()
    ax, ay, az = zy - yz, xz - zx, yx - xy  # 2 sin(angle) axis
    sine = 0.5 * math.sqrt(ax * ax + ay * ay + az * az)
    cosine = 0.5 * (xx + yy + zz - 1.0)
    angle = math.atan2(sine, cosine)
    if sine > _SMALL_ANGLE:
        scale = 0.5 * angle / sine
        return np.array((scale * ax, scale * ay, scale * az))
    if cosine > 0.0:  # no rotation to speak of: log is the antisymmetric part
        return np.array((0.5 * ax, 0.5 * ay, 0.5 * az))
    # half a turn: the axis is the eigenvector of eigenvalue 1, read off the largest diagonal entry
    symmetric = 0.5 * (rotation + rotation.T) + np.eye(3)
    column = symmetric[:, int(np.argmax(np.diag(symmetric)))]
    axis = column / np.linalg.norm(column)
    if float(axis @ np.array((ax, ay, az))) < 0.0:
        axis = -axis
    return angle * axis


def rotation_from_rpy(roll: float, pitch: float, yaw: float) -> np.ndarray:
    """Rz(yaw) Ry(pitch) Rx(roll), body to world (3, 3)."""
    cr, sr, cp, sp, cy, sy = (
        math.cos(roll),
        math.sin(roll),
        math.cos(pitch),
        math.sin(pitch),
        math.cos(yaw),
        math.sin(yaw),
    )
    return np.array(
        (
            (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
            (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
            (-sp, cp * sr, cp * cr),
        )
    )


def roll_about_forward_axis(rotation_body_to_world: np.ndarray) -> float:
    """Roll [rad] of a body about its own forward axis: positive lifts its left side."""
    return math.atan2(rotation_body_to_world[2, 1], rotation_body_to_world[2, 2])


def heading(rotation_body_to_world: np.ndarray) -> np.ndarray:
    """The yaw-only part of an orientation: (2, 2), coordinates in the body's heading frame -> horizontal world."""
    x, y = float(rotation_body_to_world[0, 0]), float(rotation_body_to_world[1, 0])
    length = math.hypot(x, y)
    c, s = (x / length, y / length) if length > _SMALL_ANGLE else (1.0, 0.0)  # pointing straight up: no heading
    return np.array(((c, -s), (s, c)))


def quaternion_wxyz(rotation: np.ndarray) -> np.ndarray:
    """Unit quaternion (4,), w first, of a rotation matrix (3, 3)."""
    vector = rotation_vector(rotation)
    half = 0.5 * math.sqrt(float(vector @ vector))
    scale = 0.5 if half < _SMALL_ANGLE else math.sin(half) / (2.0 * half)
    return np.array((math.cos(half), *(scale * vector)))


def rotation_from_xyzw(quaternion: np.ndarray) -> np.ndarray:
    """Rotation (3, 3) of a unit quaternion (4,), w last."""
    return _rotation(*quaternion.tolist())


def quaternion_xyzw(rotation: np.ndarray) -> tuple[float, float, float, float]:
    """Unit quaternion, w last, of a rotation matrix (3, 3): from the largest of its four parts, without an angle."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation.tolist()
    trace = xx + yy + zz
    if trace >= max(xx, yy, zz):
        w = 0.5 * math.sqrt(1.0 + trace)
        return 0.25 * (zy - yz) / w, 0.25 * (xz - zx) / w, 0.25 * (yx - xy) / w, w
    if xx >= yy and xx >= zz:
        x = 0.5 * math.sqrt(1.0 + xx - yy - zz)
        return x, 0.25 * (xy + yx) / x, 0.25 * (xz + zx) / x, 0.25 * (zy - yz) / x
    if yy >= zz:
        y = 0.5 * math.sqrt(1.0 - xx + yy - zz)
        return 0.25 * (xy + yx) / y, y, 0.25 * (yz + zy) / y, 0.25 * (xz - zx) / y
    z = 0.5 * math.sqrt(1.0 - xx - yy + zz)
    return 0.25 * (xz + zx) / z, 0.25 * (yz + zy) / z, z, 0.25 * (yx - xy) / z


def turn_by(vector: np.ndarray) -> np.ndarray:
    """``rotation_from_vector`` by way of the quaternion: other last digits, in a fraction of the time."""
    x, y, z = vector.tolist()
    angle = math.sqrt(x * x + y * y + z * z)
    share = 0.5 if angle < _SMALL_ANGLE else math.sin(0.5 * angle) / angle
    return _rotation(share * x, share * y, share * z, math.cos(0.5 * angle))


def _rotation(x: float, y: float, z: float, w: float) -> np.ndarray:
    return np.array(
        (
            (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)),
            (2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)),
            (2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)),
        )
    )
