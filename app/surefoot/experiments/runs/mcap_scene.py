"""What Foxglove's 3D panel draws at one instant of a saved run, as messages of its schemas: plain dictionaries."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from surefoot.experiments.runs.saved_world import SavedWorld, force_scale
from surefoot.geometry.rotations import quaternion_wxyz, rotation_from_vector
from surefoot.robot.description import RobotDescription
from surefoot.simulation.external_forces import ActingForce
from surefoot.simulation.ground import GroundPose
from surefoot.simulation.stones import HALF_BALL, stone_pose

GROUND_SIZE_M = (6.0, 6.0, 0.1)  # a slab that the roots of the stones do not show below
_STICKS = (  # of a robot with such links; others are drawn link by link
    ("l_foot", "l_shank", "l_thigh", "pelvis", "r_thigh", "r_shank", "r_foot"),
    ("pelvis", "trunk"),
)
_ROBOT = {"r": 0.8, "g": 0.47, "b": 0.13, "a": 1.0}
_STONE = {"r": 0.47, "g": 0.38, "b": 0.28, "a": 1.0}
_TERRAIN = {"r": 0.75, "g": 0.72, "b": 0.68, "a": 1.0}
_GROUND = {"r": 0.88, "g": 0.89, "b": 0.9, "a": 1.0}
_FORCE = {"r": 0.0, "g": 0.45, "b": 0.7, "a": 1.0}


def scene_entities(
    now: float,
    robot: RobotDescription,
    places: Mapping[str, tuple[np.ndarray, np.ndarray]],
    world: SavedWorld,
    row: int,
) -> list[dict[str, Any]]:
    """Robot, ground, stones, and the push or pull.

    Args:
        now: time [s] of that row.
        robot: whose links.
        places: link -> position of its centre of mass (3,) and rotation, in world.
        world: what was around the robot.
        row: of the run.
    """
    ground, force = world.at_row(row), world.force(row)
    named = all(name in places for chain in _STICKS for name in chain)
    chains = _STICKS if named else robot.link_chains
    sticks = [_line([places[name][0] for name in chain]) for chain in chains]
    stones: dict[str, list[dict[str, Any]]] = {"cubes": [], "spheres": []}
    for kind, solid in _stones(world, row, now, ground):
        stones[kind].append(solid)
    return [
        _entity(now, robot.name, lines=sticks),
        _entity(now, "ground", cubes=[_slab(ground, world.terrain.depth_m)]),
        _entity(now, "stones", **stones),
        _entity(now, "forces", arrows=[_arrow(force, force_scale(robot))] if np.isfinite(force.point).all() else []),
    ]


def terrain_entity(now: float, world: SavedWorld) -> dict[str, Any]:
    """What stands on the ground, where the ground is now."""
    ground, terrain = world.ground, world.terrain
    cubes = []
    for block in terrain.blocks:
        height = block.top_m + terrain.depth_m
        middle = ground.to_world(np.array((block.x_m, block.y_m, block.top_m - 0.5 * height)))
        size = _xyz(np.array((block.length_m, block.width_m, height)))
        cubes.append({"pose": _pose(middle, ground.rotation), "size": size, "color": _TERRAIN})
    return _entity(now, "terrain", cubes=cubes)


def transform(now: float, name: str, place: np.ndarray, rotation: np.ndarray) -> dict[str, Any]:
    """A frame of ``foxglove.FrameTransforms``."""
    return {
        "timestamp": stamp(now),
        "parent_frame_id": "world",
        "child_frame_id": name,
        "translation": _xyz(place),
        "rotation": _quaternion(rotation),
    }


def stamp(time_s: float) -> dict[str, int]:
    """A time as Foxglove has it."""
    nanoseconds = round(1e9 * time_s)
    return {"sec": nanoseconds // 10**9, "nsec": nanoseconds % 10**9}


def _stones(world: SavedWorld, row: int, now: float, ground: GroundPose) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every stone as the solid that MuJoCo has: its root in the ground included, a wedge as the box that leans."""
    for placed in world.stones(row):
        stone = placed.stone
        solid = {
            "pose": _pose(*stone_pose(stone, now, ground)),
            "size": _xyz(2.0 * stone.half_lengths()),
            "color": _STONE,
        }
        yield "spheres" if stone.shape == HALF_BALL else "cubes", solid


def _slab(ground: GroundPose, depth_m: float) -> dict[str, Any]:
    """The ground as a slab whose upper side it is."""
    middle = ground.pivot - (depth_m + 0.5 * GROUND_SIZE_M[2]) * ground.up
    return {"pose": _pose(middle, ground.rotation), "size": _xyz(np.array(GROUND_SIZE_M)), "color": _GROUND}


def _arrow(acting: ActingForce, metres_per_newton: float) -> dict[str, Any]:
    """From the point that the force acts on, along the force."""
    size = float(np.linalg.norm(acting.force))
    length = metres_per_newton * size
    return {
        "pose": _pose(acting.point, _rotation_of_x_onto(acting.force / size)),
        "shaft_length": 0.8 * length,
        "shaft_diameter": 0.016,
        "head_length": 0.2 * length,
        "head_diameter": 0.04,
        "color": _FORCE,
    }


def _rotation_of_x_onto(direction: np.ndarray) -> np.ndarray:
    """A rotation (3, 3) that takes the x axis to a unit vector (3,)."""
    _, y, z = direction.tolist()
    sine = float(np.hypot(y, z))
    angle = float(np.arctan2(sine, direction[0]))
    axis = np.array((0.0, -z, y)) / sine if sine > 0.0 else np.array((0.0, 0.0, 1.0))
    return rotation_from_vector(angle * axis)


def _entity(now: float, name: str, **shapes: list[dict[str, Any]]) -> dict[str, Any]:
    kinds = ("arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models")
    return {
        "timestamp": stamp(now),
        "frame_id": "world",
        "id": name,
        "lifetime": {"sec": 0, "nsec": 0},
        "frame_locked": False,
        "metadata": [],
        **{kind: shapes.get(kind, []) for kind in kinds},
    }


def _line(points: list[np.ndarray]) -> dict[str, Any]:
    return {
        "type": 0,
        "pose": _pose(np.zeros(3), np.eye(3)),
        "thickness": 0.04,
        "scale_invariant": False,
        "points": [_xyz(point) for point in points],
        "color": _ROBOT,
        "colors": [],
        "indices": [],
    }


def _pose(place: np.ndarray, rotation: np.ndarray) -> dict[str, Any]:
    return {"position": _xyz(place), "orientation": _quaternion(rotation)}


def _quaternion(rotation: np.ndarray) -> dict[str, float]:
    w, x, y, z = quaternion_wxyz(rotation).tolist()
    return {"x": x, "y": y, "z": z, "w": w}


def _xyz(place: np.ndarray) -> dict[str, float]:
    x, y, z = place.tolist()
    return {"x": x, "y": y, "z": z}
