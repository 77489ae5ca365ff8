"""Which link hangs on which, for those who draw a robot as sticks."""

from surefoot.robot.pinocchio_library import pin


def link_chains(model: pin.Model) -> tuple[tuple[str, ...], ...]:
    """Names of the links from the base to each link that carries no other, one for each joint on the way.

    Args:
        model: with a free-flyer root.
    """
    links: dict[int, str] = {}
    for frame in model.frames:
        if frame.type == pin.FrameType.BODY:
            links.setdefault(int(frame.parentJoint), frame.name)
    carriers = {int(model.parents[joint]) for joint in range(1, model.njoints)}
    ends = [joint for joint in range(1, model.njoints) if joint not in carriers]
    return tuple(tuple(links[joint] for joint in model.supports[end] if joint in links) for end in ends)
