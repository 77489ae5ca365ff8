"""The small biped of ``small_biped`` as URDF text: the same links, joints and shapes, without rotor inertia."""

import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tests.support.small_biped import LEG

SPHERES = "".join(
    f'<collision><origin xyz="{x} {y} -0.045"/><geometry><sphere radius="0.005"/></geometry></collision>'
    for x in (-0.06, 0.12)
    for y in (-0.035, 0.035)
)
JOINT = '<limit lower="-1.5" upper="1.5" effort="60" velocity="9"/>'
BOX = '<{0}><origin xyz="0 0 0.15"/><geometry><box size="0.1 0.2 0.3"/></geometry></{0}>'


def urdf(
    *,
    sole: str = SPHERES,
    trunk: str = BOX.format("visual") + BOX.format("collision"),
    joint: str = JOINT,
    extra: str = "",
    leg: Sequence[tuple[str, str, str, float]] = LEG,
) -> str:
    """URDF text.

    Args:
        sole: shapes of a foot.
        trunk: shapes of the trunk.
        joint: elements of each leg joint.
        extra: more links, joints and other elements.
        leg: joint, axis, offset and mass of each link, from the hip down.
    """
    parts = [link("pelvis", 3.0, "0 0 0", (0.01, 0.01, 0.01))]
    for side, y in (("left", 0.08), ("right", -0.08)):
        above = "pelvis"
        for name, axis, offset, mass in leg:
            below = f"{side}_{name}_link"
            shapes = sole if name == leg[-1][0] else ""
            parts.append(link(below, mass, "0 0 -0.02", (0.004, 0.003, 0.002), shapes))
            parts.append(hinge(f"{side}_{name}", above, below, offset.format(y=y), axis, joint))
            above = below
    parts.append(link("trunk", 5.6, "0 0 0.15", (0.05, 0.05, 0.02), trunk))
    limit = '<limit lower="-{0}" upper="{0}" effort="60" velocity="9"/>'
    parts.append(hinge("waist", "pelvis", "trunk", "0 0 0.05", "0 0 1", limit.format(1)))
    parts.append(link("arm", 0.4, "0.2 0 0", (0.001, 0.001, 0.001)))
    parts.append(hinge("shoulder", "trunk", "arm", "0 0.1 0.2", "0 1 0", limit.format(2)))
    return f'<robot name="small">{"".join(parts)}{extra}</robot>'


def link(name: str, mass: float, centre: str, inertia: tuple[float, float, float], shapes: str = "") -> str:
    """A link with its principal moments along its axes [kg, m, kg m2]."""
    x, y, z = inertia
    moments = f'ixx="{x}" iyy="{y}" izz="{z}" ixy="0" ixz="0" iyz="0"'
    inertial = f'<inertial><origin xyz="{centre}"/><mass value="{mass}"/><inertia {moments}/></inertial>'
    return f'<link name="{name}">{inertial}{shapes}</link>'


def hinge(name: str, above: str, below: str, origin: str, axis: str, more: str = JOINT, kind: str = "revolute") -> str:
    """A joint of that kind."""
    ends = f'<parent link="{above}"/><child link="{below}"/><origin xyz="{origin}"/><axis xyz="{axis}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{more}</joint>'


def mesh(kind: str, name: str) -> str:
    """A shape, ``visual`` or ``collision``, that is a mesh of that name."""
    return f'<{kind}><geometry><mesh filename="{name}"/></geometry></{kind}>'


def write_stl(path: Path, size_m: float = 0.05) -> None:
    """A binary STL of a tetrahedron."""
    path.parent.mkdir(parents=True, exist_ok=True)
    corners = size_m * np.vstack((np.zeros(3), np.eye(3)))
    faces = [corners[list(face)].ravel() for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))]
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *face, 0) for face in faces)
    path.write_bytes(bytes(80) + struct.pack("<I", len(faces)) + body)
