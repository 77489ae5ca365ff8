"""The plain MJCF made fit for the controllers: torque motors instead of servos, one convex sole a foot."""

from collections.abc import Mapping
from copy import deepcopy
from xml.etree.ElementTree import Element, SubElement

from surefoot.robot.feet import Side
from surefoot.robot_import.limits import Drives
from surefoot.robot_import.mjcf_writer import BODY_GROUP, OFF_GROUP, VISUAL_GROUP, write_sole
from surefoot.robot_import.normalise import PlainMjcf
from surefoot.robot_import.sole import Sole


def sole_name(side: Side) -> str:
    """Name of the mesh and the geom of a sole."""
    return f"{side}_sole"


def fit_mjcf(
    plain: PlainMjcf, drives: Drives, foot_links: Mapping[Side, list[str]], soles: Mapping[Side, Sole]
) -> PlainMjcf:
    """The MJCF that is simulated.

    Args:
        plain: the robot as its owner wrote it, spelled out.
        drives: of its joints.
        foot_links: side -> names of the bodies that move with the foot, the foot's own first; empty: no soles yet.
        soles: of the feet.
    """
    fit = PlainMjcf(deepcopy(plain.root), list(plain.changed), list(plain.dropped))
    _replace_servos(fit, drives)
    for side, bodies in foot_links.items():
        _replace_sole(fit, side, bodies, soles[side])
    return fit


def _replace_servos(fit: PlainMjcf, drives: Drives) -> None:
    actuators = SubElement(fit.root, "actuator")
    dampings = {}
    for joint in fit.root.iter("joint"):
        name = joint.get("name", "")
        if name in drives.limits:
            limit = repr(drives.limits[name].torque_nm)
            SubElement(actuators, "motor", name=name, joint=name, ctrlrange=f"-{limit} {limit}")
        damping = float(joint.get("damping", "0"))
        if drives.stands_in(name) and damping > 0.0:
            dampings[name] = damping
            joint.set("damping", "0.0")
    if drives.servos:
        fit.changed.append(f"{len(drives.servos)} position or speed actuators became torque motors")
    if dampings:
        span = f"{min(dampings.values()):g} to {max(dampings.values()):g} N m s/rad"
        fit.changed.append(
            f"damping of {len(dampings)} joints taken out ({span}): it stood in for their servos' rate gain"
        )
    if drives.undriven and len(drives.undriven) == len(list(fit.root.iter("joint"))):
        fit.changed.append("no joint has an actuator: each is given a motor")
    elif drives.undriven:
        fit.changed.append(f"joints without an actuator given a motor: {', '.join(drives.undriven)}")
    if drives.uneven:
        fit.changed.append(f"limits that differ by direction, the smaller taken: {', '.join(drives.uneven)}")


def _replace_sole(fit: PlainMjcf, side: Side, bodies: list[str], sole: Sole) -> None:
    """One convex mesh instead of all the collision shapes of a foot: a stone cannot slip between two spheres."""
    elements = {body.get("name"): body for body in fit.root.iter("body")}
    kinds = []
    for name in bodies:
        for geom in elements[name].findall("geom"):
            if geom.get("group") in (BODY_GROUP, OFF_GROUP):
                kinds.append(geom.get("type", ""))
                elements[name].remove(geom)
            elif geom.get("group") == VISUAL_GROUP and geom.get("contype") != "0":
                kinds.append(geom.get("type", ""))
                _only_draw(geom)
    write_sole(fit.root, elements[bodies[0]], sole_name(side), sole.mesh_in_body())
    counts = ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds))) or "none"
    fit.changed.append(
        f"{side} sole: one convex mesh of {len(sole.outline.vertices)} corners for its shapes ({counts})"
    )


def _only_draw(geom: Element) -> None:
    geom.set("contype", "0")
    geom.set("conaffinity", "0")
