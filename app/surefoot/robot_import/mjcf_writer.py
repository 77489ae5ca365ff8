"""Writes the bodies of a compiled model as plain MJCF: every number spelled out to its last digit, nothing inherited.

MuJoCo's own writer rounds to six digits, and keeps ``<frame>``, whose bodies Pinocchio drops without a word.
"""

from collections.abc import Iterable, Mapping
from typing import Any
from xml.etree.ElementTree import Element, SubElement

import mujoco
import numpy as np

SOLE_GROUP, BODY_GROUP, OFF_GROUP, VISUAL_GROUP = "3", "4", "5", "2"
# As simulation/world.py wants it: the robot touches ground, stones and blocks, never itself
TOUCHING: dict[str, Any] = {"contype": "1", "conaffinity": "2"}
_NOT_TOUCHING: dict[str, Any] = {"contype": "0", "conaffinity": "0"}
_DEFAULT_RGBA = (0.5, 0.5, 0.5, 1.0)
_SHAPES = {"sphere": 1, "capsule": 2, "ellipsoid": 3, "cylinder": 2, "box": 3}  # numbers of `size` that count


def numbers(values: Iterable[float]) -> str:
    """Numbers as MJCF wants them, to the last digit."""
    return " ".join(repr(float(value)) for value in values)


def empty_mjcf(name: str) -> Element:
    """An MJCF without bodies."""
    root = Element("mujoco", model=name)
    SubElement(root, "compiler", angle="radian", autolimits="true", inertiafromgeom="false")
    SubElement(root, "asset")
    SubElement(root, "worldbody")
    return root


def write_inertial(body: Element, model: mujoco.MjModel, index: int) -> None:
    """Mass, centre of mass and principal moments of a body; Pinocchio wants them of a massless one too."""
    SubElement(
        body,
        "inertial",
        pos=numbers(model.body_ipos[index]),
        quat=numbers(model.body_iquat[index]),
        mass=repr(float(model.body_mass[index])),
        diaginertia=numbers(model.body_inertia[index]),
    )


def write_hinge(body: Element, model: mujoco.MjModel, joint: int, anchor: np.ndarray, axis: np.ndarray) -> Element:
    """A hinge with its linear spring; its angle is 0 where the bodies are drawn, whatever ``ref`` said.

    Args:
        body: the element of its body.
        model: compiled.
        joint: its index.
        anchor: (3,) a point on its axis in the frame of the body [m].
        axis: (3,) in the frame of the body.
    """
    dof, ref = int(model.jnt_dofadr[joint]), float(model.qpos0[model.jnt_qposadr[joint]])
    limits = model.jnt_range[joint] - ref if model.jnt_limited[joint] else np.array([-np.pi, np.pi])
    spring: dict[str, Any] = {}
    if model.jnt_stiffness[joint] != 0.0:
        rest = float(model.qpos_spring[model.jnt_qposadr[joint]]) - ref
        spring = {"stiffness": repr(float(model.jnt_stiffness[joint])), "springref": repr(rest)}
    return SubElement(
        body,
        "joint",
        name=model.joint(joint).name,
        type="hinge",
        pos=numbers(anchor),
        axis=numbers(axis),
        range=numbers(limits),
        armature=repr(float(model.dof_armature[dof])),
        damping=repr(float(model.dof_damping[dof])),
        frictionloss=repr(float(model.dof_frictionloss[dof])),
        **spring,
    )


def write_geom(
    root: Element, body: Element, model: mujoco.MjModel, geom: int, meshes: Mapping[int, str], *, touching: bool
) -> bool:
    """A geom without mass; says whether it could be written (no plane, height field or signed distance field).

    Args:
        root: the MJCF.
        body: the element of its body.
        model: compiled.
        geom: its index.
        meshes: mesh index -> name.
        touching: whether it touches something in the model, by its bits or in a pair.
    """
    shape = mujoco.mjtGeom(model.geom_type[geom]).name.removeprefix("mjGEOM_").lower()
    drawn = model.geom_group[geom] < 3
    group = VISUAL_GROUP if drawn else BODY_GROUP if touching else OFF_GROUP
    common: dict[str, Any] = {"mass": "0", "group": group, "material": _material(root, model, geom)}
    common |= TOUCHING if touching else _NOT_TOUCHING
    position, quaternion = model.geom_pos[geom], model.geom_quat[geom]
    if shape == "mesh":
        mesh = int(model.geom_dataid[geom])
        position, quaternion = _as_drawn(model, mesh, position, quaternion)
        SubElement(
            body, "geom", type="mesh", mesh=meshes[mesh], pos=numbers(position), quat=numbers(quaternion), **common
        )
        return True
    if shape not in _SHAPES:
        return False
    size = numbers(model.geom_size[geom][: _SHAPES[shape]])
    SubElement(body, "geom", type=shape, size=size, pos=numbers(position), quat=numbers(quaternion), **common)
    return True


def write_mesh(root: Element, model: mujoco.MjModel, mesh: int, *, by_file: bool) -> str:
    """A mesh, by the whole path of its file if it has one and ``by_file``, else by its vertices; says its name.

    ``shell``: a thin mesh has no volume to speak of, and none is asked for: the geoms have no mass.
    """
    name = model.mesh(mesh).name or f"mesh_{mesh}"
    element = SubElement(_asset(root), "mesh", name=name, inertia="shell")
    if by_file and (path := _path(model, mesh)):
        element.set("file", path)
        element.set("scale", numbers(model.mesh_scale[mesh]))
    else:
        vertices, faces = mesh_vertices(model, mesh), _faces(model, mesh)
        element.set("vertex", numbers(_drawn_vertices(model, mesh, vertices).ravel()))
        element.set("face", " ".join(str(int(corner)) for corner in faces.ravel()))
    return name


def write_sole(root: Element, body: Element, name: str, vertices: np.ndarray) -> None:
    """A convex mesh (n, 3) in the frame of a body that touches the ground [m]."""
    SubElement(_asset(root), "mesh", name=name, vertex=numbers(vertices.ravel()))
    SubElement(body, "geom", name=name, type="mesh", mesh=name, mass="0", group=SOLE_GROUP, **TOUCHING)


def mesh_vertices(model: mujoco.MjModel, mesh: int) -> np.ndarray:
    """(n, 3) vertices in the frame of a geom with that mesh [m]."""
    first = int(model.mesh_vertadr[mesh])
    return model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])].astype(float)


def _asset(root: Element) -> Element:
    asset = root.find("asset")
    assert asset is not None
    return asset


def _faces(model: mujoco.MjModel, mesh: int) -> np.ndarray:
    first = int(model.mesh_faceadr[mesh])
    return model.mesh_face[first : first + int(model.mesh_facenum[mesh])]


def _path(model: mujoco.MjModel, mesh: int) -> str:
    start = int(model.mesh_pathadr[mesh])
    return model.paths[start : model.paths.find(b"\0", start)].decode() if start >= 0 else ""


def _as_drawn(
    model: mujoco.MjModel, mesh: int, position: np.ndarray, quaternion: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Pose of the mesh's file in its body: MuJoCo moves each mesh to its own centre and turns the geom along."""
    back, turned, shift = np.zeros(4), np.zeros(4), np.zeros(3)
    mujoco.mju_negQuat(back, model.mesh_quat[mesh])
    mujoco.mju_mulQuat(turned, quaternion, back)
    mujoco.mju_rotVecQuat(shift, model.mesh_pos[mesh], turned)
    return position - shift, turned


def _drawn_vertices(model: mujoco.MjModel, mesh: int, vertices: np.ndarray) -> np.ndarray:
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, model.mesh_quat[mesh])
    return vertices @ matrix.reshape(3, 3).T + model.mesh_pos[mesh]


def _material(root: Element, model: mujoco.MjModel, geom: int) -> str:
    """Name of the material that looks like a geom, written if it is a new one; textures are left out.

    Every shape has one: a robot is drawn material by material.
    """
    own, number = model.geom_rgba[geom], int(model.geom_matid[geom])
    from_file = number >= 0 and tuple(own) == _DEFAULT_RGBA
    look: dict[str, Any] = {"rgba": numbers(model.mat_rgba[number] if from_file else own)}
    if from_file:
        look |= {"metallic": repr(float(model.mat_metallic[number]))}
        look |= {"roughness": repr(float(model.mat_roughness[number]))}
    materials = _asset(root).findall("material")
    for material in materials:
        if all(material.get(key) == look.get(key) for key in ("rgba", "metallic", "roughness")):
            return material.get("name", "")
    SubElement(_asset(root), "material", name=f"look_{len(materials)}", **look)
    return f"look_{len(materials)}"
