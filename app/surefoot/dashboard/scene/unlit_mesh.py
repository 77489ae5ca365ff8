"""Shapes that have one colour in any light, as binary glTF: signs, not things."""

from collections.abc import Sequence

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

from surefoot.dashboard.scene.marker_meshes import Mesh
from surefoot.dashboard.ui import palette

Part = tuple[Mesh, palette.Rgb]


def glowing_glb(parts: Sequence[Part]) -> bytes:
    """Meshes, each with its colour."""
    scene = trimesh.Scene()
    for number, ((vertices, faces), colour) in enumerate(parts):
        mesh = trimesh.Trimesh(vertices, faces, process=False)
        light = linear(np.array(colour) / 255.0).tolist()
        mesh.visual = TextureVisuals(material=PBRMaterial(
            baseColorFactor=[0.0, 0.0, 0.0, 1.0], emissiveFactor=light, metallicFactor=0.0, roughnessFactor=1.0,
            doubleSided=True,
        ))  # fmt: skip
        scene.add_geometry(mesh, geom_name=f"part_{number}")
    data = scene.export(file_type="glb")
    assert isinstance(data, bytes)
    return data


def linear(srgb: np.ndarray) -> np.ndarray:
    """Colours as written, 0 to 1 (sRGB), in the linear light that glTF wants."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
