"""Bodies with several hinges as chains of links with one each: Pinocchio makes one nameless joint of such a body."""

from itertools import pairwise
from xml.etree.ElementTree import Element, SubElement


def split_hinges(root: Element) -> list[str]:
    """Give every hinge of a plain MJCF a link of its own, in place.

    MuJoCo turns a body about its hinges in the order of the file, the first one outermost, each axis and anchor given
    in the body's frame as the hinges before it have turned it. So a chain of links whose frames are that of the body
    where all hinges are at 0, one hinge each in that order, moves the same way; the last link keeps the body's name,
    its mass and all that hangs on it, the others have none. MuJoCo refuses massless links that move, and needs no
    chain.

    Args:
        root: bodies with their joints as ``mjcf_writer`` spells them out.

    Returns:
        Names of the massless links.
    """
    carriers = []
    for body in list(root.iter("body")):
        joints, parts, name = body.findall("joint"), list(body), body.get("name", "")
        if len(joints) < 2:
            continue
        for part in parts:
            body.remove(part)
        link = body
        for joint, following in pairwise(joints):
            carrier = f"between {joint.get('name')} and {following.get('name')}"
            carriers.append(carrier)
            link.set("name", carrier)
            SubElement(link, "inertial", pos="0 0 0", mass="0", diaginertia="0 0 0")
            link.append(joint)
            link = SubElement(link, "body")
        link.set("name", name)
        link.extend([part for part in parts if part not in joints[:-1]])
    return carriers
