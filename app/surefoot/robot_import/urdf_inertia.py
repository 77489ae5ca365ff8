"""The masses of a URDF's links, made such that MuJoCo takes them: it wants mass and inertia in every link that moves.

URDF writers put massless links between the hinges of a hip or shoulder, and point masses; both are sound mechanics as
long as each joint moves something.
"""

from collections.abc import Iterator, Mapping
from xml.etree.ElementTree import Element, SubElement

import numpy as np

_LEAST_MASS_KG, _LEAST_INERTIA_KGM2 = 1e-9, 1e-9
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_ROWS = ((0, 1, 2), (1, 3, 4), (2, 4, 5))


def make_inertias_positive(root: Element) -> Iterator[str]:
    """Change the links of a URDF in place; says what, one line each.

    Raises:
        ValueError: a mass or moment is no number.
    """
    moving = {_link(joint, "child") for joint in root.findall("joint") if joint.get("type") != "fixed"}
    massless, points = [], []
    for link in root.findall("link"):
        name, inertial = link.get("name", ""), link.find("inertial")
        if _mass(link) <= 0.0:
            if inertial is not None:
                link.remove(inertial)
            if name in moving:
                massless.append(name)
                _write_inertial(link)
        elif inertial is not None and (inertia := inertial.find("inertia")) is not None:
            moments = np.array([float(inertia.get(key, "0")) for key in _MOMENTS])
            smallest = float(np.linalg.eigvalsh(moments[list(map(list, _ROWS))])[0])
            if abs(smallest) < _LEAST_INERTIA_KGM2:
                points.append(name)
                for key in ("ixx", "iyy", "izz"):
                    inertia.set(key, repr(float(inertia.get(key, "0")) + _LEAST_INERTIA_KGM2))
    if massless:
        yield f"links that move and have no mass given {_LEAST_MASS_KG:g} kg: {', '.join(massless)}"
    if points:
        yield f"links with no inertia about an axis given {_LEAST_INERTIA_KGM2:g} kg m2 more: {', '.join(points)}"


def joints_that_move_nothing(root: Element) -> tuple[str, ...]:
    """Names of the joints of a URDF below which no link has mass. Raises ValueError: a mass is no number."""
    masses = {link.get("name", ""): _mass(link) for link in root.findall("link")}
    below: dict[str, list[str]] = {}
    for joint in root.findall("joint"):
        below.setdefault(_link(joint, "parent"), []).append(_link(joint, "child"))
    return tuple(
        joint.get("name", "")
        for joint in root.findall("joint")
        if joint.get("type") != "fixed" and not _has_mass(_link(joint, "child"), masses, below, frozenset())
    )


def _has_mass(link: str, masses: Mapping[str, float], below: Mapping[str, list[str]], above: frozenset[str]) -> bool:
    if link in above:  # a loop, which MuJoCo refuses
        return True
    return masses.get(link, 0.0) > 0.0 or any(
        _has_mass(child, masses, below, above | {link}) for child in below.get(link, ())
    )


def _mass(link: Element) -> float:
    mass = link.find("inertial/mass")
    return 0.0 if mass is None else float(mass.get("value", "0"))


def _link(joint: Element, end: str) -> str:
    element = joint.find(end)
    return "" if element is None else element.get("link", "")


def _write_inertial(link: Element) -> None:
    inertial = SubElement(link, "inertial")
    SubElement(inertial, "mass", value=repr(_LEAST_MASS_KG))
    moments = {key: repr(_LEAST_INERTIA_KGM2 if key in ("ixx", "iyy", "izz") else 0.0) for key in _MOMENTS}
    SubElement(inertial, "inertia", moments)
