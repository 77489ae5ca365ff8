"""Which link hangs on which joint, and on which other link."""

from surefoot.robot.pinocchio_library import pin


def carried_links(model: pin.Model) -> dict[int, str]:
    """Joint -> name of the link it carries; links that are welded to it count as part of it.

    Where several hinges turn one link only the last of them is there.

    Args:
        model: with a free-flyer root.
    """
    links: dict[int, str] = {}
    for frame in model.frames:
        if frame.type == pin.FrameType.BODY:
            links.setdefault(int(frame.parentJoint), frame.name)
    return links


def link_chains(model: pin.Model) -> tuple[tuple[str, ...], ...]:
    """Names of the links from the base to each link that carries no other.

    Args:
        model: with a free-flyer root.
    """
    links = carried_links(model)
    carriers = {int(model.parents[joint]) for joint in range(1, model.njoints)}
    ends = [joint for joint in range(1, model.njoints) if joint not in carriers]
    return tuple(tuple(links[joint] for joint in model.supports[end] if joint in links) for end in ends)
