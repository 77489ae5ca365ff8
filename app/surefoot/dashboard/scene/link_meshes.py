"""The robot's links as binary glTF: edges kept crisp, round things smooth, metal shining like metal."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import trimesh
from mjviser.conversions import create_primitive_mesh, mujoco_mesh_to_trimesh
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

from surefoot.dashboard.scene.unlit_mesh import linear
from surefoot.dashboard.ui import palette

_SMOOTH_RAD = 0.5  # faces that meet at less than this look like one round surface
_ROUGHNESS, _METALLIC = 0.7, 0.0  # of a material that says nothing


def link_glb(
    model: Any, geoms: Sequence[int], *, tint: palette.Rgb | None = None, mix: float = 0.65, opacity: float = 1.0
) -> bytes:
    """The geoms of one body as glTF in the body's axes, one mesh for each material.

    Args:
        model: MuJoCo's.
        geoms: numbers of the geoms.
        tint: colour that the materials' own are mixed with.
        mix: how much of it, 0 to 1.
        opacity: 0 to 1.
    """
    scene = trimesh.Scene()
    for material in sorted({int(model.geom_matid[geom]) for geom in geoms}):
        parts = [_shape(model, geom) for geom in geoms if model.geom_matid[geom] == material]
        mesh = _joined(parts)
        mesh.visual = TextureVisuals(material=_material(model, material, tint, mix, opacity))
        scene.add_geometry(mesh, geom_name=f"material_{material}")
    data = scene.export(file_type="glb", include_normals=True)
    assert isinstance(data, bytes)
    return data


def _joined(parts: list[trimesh.Trimesh]) -> trimesh.Trimesh:
    first = np.cumsum([0, *(len(part.vertices) for part in parts)])
    faces = [part.faces + offset for part, offset in zip(parts, first, strict=False)]
    return trimesh.Trimesh(np.vstack([part.vertices for part in parts]), np.vstack(faces), process=False)


def _shape(model: Any, geom: int) -> trimesh.Trimesh:
    """One geom in its body's axes, its vertices split where an edge should be seen."""
    is_mesh = model.geom_dataid[geom] >= 0
    mesh = mujoco_mesh_to_trimesh(model, geom) if is_mesh else create_primitive_mesh(model, geom)
    mesh = trimesh.Trimesh(mesh.vertices, mesh.faces)
    pose = trimesh.transformations.quaternion_matrix(model.geom_quat[geom])
    pose[:3, 3] = model.geom_pos[geom]
    mesh.apply_transform(pose)
    return trimesh.graph.smooth_shade(mesh, angle=_SMOOTH_RAD, facet_minarea=None)


def _material(model: Any, number: int, tint: palette.Rgb | None, mix: float, opacity: float) -> PBRMaterial:
    rgb = model.mat_rgba[number, :3].copy()
    if tint is not None:
        rgb = (1.0 - mix) * rgb + mix * np.array(tint) / 255.0
    metallic, roughness = float(model.mat_metallic[number]), float(model.mat_roughness[number])
    return PBRMaterial(
        baseColorFactor=[*linear(rgb).tolist(), opacity], alphaMode="OPAQUE" if opacity >= 1.0 else "BLEND",
        metallicFactor=metallic if metallic >= 0.0 else _METALLIC,
        roughnessFactor=roughness if roughness >= 0.0 else _ROUGHNESS,
    )  # fmt: skip
