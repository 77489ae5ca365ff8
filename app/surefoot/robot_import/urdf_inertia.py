"""The masses of a URDF's links, made such that MuJoCo takes them: it wants mass and inertia in every link that moves.

URDF writers put massless links between the hinges of a hip or shoulder, and point masses; both are sound mechanics as
long as each joint moves something.
"""

from collections.abc import Iterator, Mapping
from xml.etree.ElementTree import Element, SubElement

import numpy as np

_LEAST = 1e-9  # kg, and kg m2
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_DIAGONAL = ("ixx", "iyy", "izz")


def make_inertias_positive(root: Element) -> Iterator[str]:
    """Change the links of a URDF in place; says what, one line each.

    Raises:
        ValueError: a mass or moment is no number.
    """
    moving = {_link(joint, "child") for joint in root.findall("joint") if joint.get("type") != "fixed"}
    massless, points = [], []
    for link in root.findall("link"):
        name, mass, moments = link.get("name", ""), _mass(link), _moments(link)
        if mass <= 0.0 and name not in moving and not moments.any():
            for inertial in link.findall("inertial"):
                link.remove(inertial)
            continue
        if mass <= 0.0:
            massless.append(name)
            _part(link, "mass").set("value", repr(_LEAST))
        if abs(float(np.linalg.eigvalsh(moments)[0])) < _LEAST:
            if mass > 0.0:
                points.append(name)
            inertia = _part(link, "inertia")
            for key in _MOMENTS:
                inertia.set(key, repr(float(inertia.get(key, "0")) + (_LEAST if key in _DIAGONAL else 0.0)))
    if massless:
        yield f"links that move and have no mass given {_LEAST:g} kg: {', '.join(massless)}"
    if points:
        yield f"links with no inertia about an axis given {_LEAST:g} kg m2 more: {', '.join(points)}"


def joints_that_move_nothing(root: Element) -> tuple[str, ...]:
    """Names of the joints of a URDF below which no link has mass or inertia.

    Raises:
        ValueError: a mass or moment is no number.
    """
    weighs = {link.get("name", ""): _mass(link) > 0.0 or bool(_moments(link).any()) for link in root.findall("link")}
    below: dict[str, list[str]] = {}
    for joint in root.findall("joint"):
        below.setdefault(_link(joint, "parent"), []).append(_link(joint, "child"))
    return tuple(
        joint.get("name", "")
        for joint in root.findall("joint")
        if joint.get("type") != "fixed" and not _carries(_link(joint, "child"), weighs, below, frozenset())
    )


def _carries(link: str, weighs: Mapping[str, bool], below: Mapping[str, list[str]], above: frozenset[str]) -> bool:
    if link in above:  # a loop, which MuJoCo refuses
        return True
    return weighs.get(link, False) or any(
        _carries(child, weighs, below, above | {link}) for child in below.get(link, ())
    )


def _mass(link: Element) -> float:
    mass = link.find("inertial/mass")
    return 0.0 if mass is None else float(mass.get("value", "0"))


def _moments(link: Element) -> np.ndarray:
    """(3, 3) moments of inertia as written [kg m2]."""
    inertia = link.find("inertial/inertia")
    xx, xy, xz, yy, yz, zz = (0.0 if inertia is None else float(inertia.get(key, "0")) for key in _MOMENTS)
    return np.array(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)))


def _part(link: Element, tag: str) -> Element:
    """``<mass>`` or ``<inertia>`` of a link, made where there is none."""
    inertial = link.find("inertial")
    inertial = SubElement(link, "inertial") if inertial is None else inertial
    part = inertial.find(tag)
    return SubElement(inertial, tag) if part is None else part


def _link(joint: Element, end: str) -> str:
    element = joint.find(end)
    return "" if element is None else element.get("link", "")
