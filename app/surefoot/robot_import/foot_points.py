"""The points of a foot's collision shapes that could touch the ground."""

from collections.abc import Sequence

import mujoco
import numpy as np

from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.mjcf_writer import mesh_vertices

_RIM = 32  # points on the rim of a cylinder


def collision_geoms(tree: KinematicTree, body: int) -> tuple[list[int], str]:
    """The shapes of a foot that count, and which those are.

    What touches something; else shapes that are switched off and not drawn (a scene file may switch them on by pairs
    for its own floor only); else nothing: a drawn mesh is no sole.
    """
    model, geoms = tree.model, tree.geoms(body)
    touching = [geom for geom in geoms if model.geom_contype[geom] or model.geom_conaffinity[geom]]
    if touching:
        return touching, "its collision shapes"
    off = [geom for geom in geoms if model.geom_group[geom] >= 3]
    return off, "its collision shapes, which the file switches off (contype 0)" if off else "none"


def lowest_height(tree: KinematicTree, body: int) -> float | None:
    """Height of the lowest point of a body's shapes in world [m]; None: it has no shape at all."""
    geoms = collision_geoms(tree, body)[0] or tree.geoms(body)
    return float(foot_points(tree, geoms, np.array((0.0, 0.0, -1.0)))[:, 2].min()) if geoms else None


def foot_points(tree: KinematicTree, geoms: Sequence[int], down: np.ndarray) -> np.ndarray:
    """(n, 3) points in world [m]: corners of boxes and meshes, and where round shapes reach furthest ``down``.

    Args:
        tree: the robot in its posture.
        geoms: indices of the shapes.
        down: (3,) unit direction in world.
    """
    return np.vstack([_points(tree, geom, down) for geom in geoms]) if geoms else np.zeros((0, 3))


def _points(tree: KinematicTree, geom: int, down: np.ndarray) -> np.ndarray:
    model, data = tree.model, tree.data
    rotation, centre = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    size, shape = model.geom_size[geom], model.geom_type[geom]
    kinds = mujoco.mjtGeom
    if shape == kinds.mjGEOM_SPHERE:
        return (centre + size[0] * down)[None]
    if shape == kinds.mjGEOM_CAPSULE:
        ends = np.outer((-1.0, 1.0), size[1] * rotation[:, 2])
        return centre + ends + size[0] * down
    if shape == kinds.mjGEOM_ELLIPSOID:
        local = rotation.T @ down
        return (centre + rotation @ (size**2 * local / np.linalg.norm(size * local)))[None]
    if shape == kinds.mjGEOM_CYLINDER:
        angles = np.linspace(0.0, 2.0 * np.pi, _RIM, endpoint=False)
        rim = np.column_stack((size[0] * np.cos(angles), size[0] * np.sin(angles)))
        local = np.vstack([np.column_stack((rim, np.full(_RIM, end * size[1]))) for end in (-1.0, 1.0)])
    elif shape == kinds.mjGEOM_BOX:
        local = size * np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    else:
        local = mesh_vertices(model, int(model.geom_dataid[geom]))
    return centre + local @ rotation.T
