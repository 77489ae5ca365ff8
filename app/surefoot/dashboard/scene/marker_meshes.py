"""Small meshes for markers: disc, ring, filled convex polygon; and signs that have one colour in any light."""

from collections.abc import Sequence

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

from surefoot.dashboard.ui import palette

MOST_CORNERS = 8
Mesh = tuple[np.ndarray, np.ndarray]


def disc(radius: float, thickness: float, sides: int = 28) -> Mesh:
    """A flat cylinder about the origin, axis up: vertices and faces."""
    angle = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    rim = radius * np.column_stack((np.cos(angle), np.sin(angle)))
    top = np.column_stack((rim, np.full(sides, 0.5 * thickness)))
    bottom = np.column_stack((rim, np.full(sides, -0.5 * thickness)))
    vertices = np.vstack((top, bottom, [(0.0, 0.0, 0.5 * thickness)]))
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        faces += [(2 * sides, i, j), (i, sides + i, sides + j), (i, sides + j, j)]
    return vertices, np.array(faces)


def ring(inner: float, outer: float, thickness: float, sides: int = 32) -> Mesh:
    """A flat ring about the origin, axis up: vertices and faces."""
    angle = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    levels = [(inner, 0.5), (outer, 0.5), (outer, -0.5), (inner, -0.5)]
    vertices = np.vstack([np.column_stack((r * circle, np.full(sides, z * thickness))) for r, z in levels])
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        for a in range(4):
            p, q = a * sides, (a + 1) % 4 * sides
            faces += [(p + i, q + i, q + j), (p + i, q + j, p + j)]
    return vertices, np.array(faces)


def quartered_disc(radius: float, thickness: float, sides: int = 32) -> tuple[Mesh, Mesh]:
    """A disc as two meshes of two opposite quarters each: the sign of a centre of mass."""
    vertices, faces = disc(radius, thickness, sides)
    middle = vertices[faces].mean(axis=1)
    dark = middle[:, 0] * middle[:, 1] > 0.0
    return (vertices, faces[~dark]), (vertices, faces[dark])


def quartered_ball(radius: float, sides: int = 32) -> tuple[Mesh, Mesh]:
    """A ball as two meshes of four opposite eighths each."""
    polar = np.linspace(0.0, np.pi, sides // 2 + 1)
    around = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    p, a = (grid.ravel() for grid in np.meshgrid(polar, around, indexing="ij"))
    vertices = radius * np.column_stack((np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)))
    faces = []
    for i in range(sides // 2):
        for j in range(sides):
            here, beside = i * sides + j, i * sides + (j + 1) % sides
            faces += [(here, here + sides, beside + sides), (here, beside + sides, beside)]
    triangles = np.array(faces)
    dark = vertices[triangles].mean(axis=1).prod(axis=1) > 0.0
    return (vertices, triangles[~dark]), (vertices, triangles[dark])


def bar(low: tuple[float, float], high: tuple[float, float]) -> Mesh:
    """A flat rectangle on the ground."""
    (a, b), (c, d) = low, high
    return np.array([(a, b, 0.0), (c, b, 0.0), (c, d, 0.0), (a, d, 0.0)]), np.array([(0, 1, 2), (0, 2, 3)])


def fan_faces(count: int = MOST_CORNERS) -> np.ndarray:
    """Faces of a fan over ``count`` corners."""
    return np.array([(0, i, i + 1) for i in range(1, count - 1)])


def padded(corners: np.ndarray, count: int = MOST_CORNERS) -> np.ndarray:
    """Corners (n <= count, 3), the last one repeated, so that a mesh never changes its size."""
    missing = count - len(corners)
    return np.vstack((corners, np.repeat(corners[-1:], missing, axis=0))) if missing > 0 else corners[:count]


def outline_segments(corners: np.ndarray) -> np.ndarray:
    """Line segments (n, 2, 3) around a polygon (n, 3)."""
    return np.stack((corners, np.roll(corners, -1, axis=0)), axis=1)


def path_segments(points: np.ndarray, count: int) -> np.ndarray:
    """A path (n, 3) as exactly ``count`` segments (count, 2, 3), short ones repeated at its newest end."""
    segments = np.zeros((count, 2, 3)) if len(points) == 0 else np.tile(points[-1], (count, 2, 1))
    if len(points) > 1:
        pairs = np.stack((points[:-1], points[1:]), axis=1)[-count:]
        segments[: len(pairs)] = pairs
    return segments


Part = tuple[Mesh, palette.Rgb]


def glowing_glb(parts: Sequence[Part]) -> bytes:
    """Meshes, each with its colour."""
    scene = trimesh.Scene()
    for number, ((vertices, faces), colour) in enumerate(parts):
        mesh = trimesh.Trimesh(vertices, faces, process=False)
        light = linear(np.array(colour) / 255.0).tolist()
        mesh.visual = TextureVisuals(
            material=PBRMaterial(
                baseColorFactor=[0.0, 0.0, 0.0, 1.0],
                emissiveFactor=light,
                metallicFactor=0.0,
                roughnessFactor=1.0,
                doubleSided=True,
            )
        )
        scene.add_geometry(mesh, geom_name=f"part_{number}")
    data = scene.export(file_type="glb")
    assert isinstance(data, bytes)
    return data


def linear(srgb: np.ndarray) -> np.ndarray:
    """Colours as written, 0 to 1 (sRGB), in the linear light that glTF wants."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
