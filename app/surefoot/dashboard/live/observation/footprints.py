"""The soles of the steps to come, as a walk has planned them."""

import numpy as np

from surefoot.dashboard.messages.footprint import Footprint, footprints_of
from surefoot.simulation.loop import Simulation
from surefoot.simulation.plant import FootTruth


def footprints(simulation: Simulation, feet: tuple[FootTruth, FootTruth]) -> tuple[Footprint, ...]:
    """The next steps, the first one first, as high as what stands; none of a robot that has fallen or does not walk.

    Args:
        simulation: whose gait.
        feet: where they are now.
    """
    gait, soles = simulation.gait, simulation.robot.feet
    if gait is None or simulation.fallen is not None:
        return ()
    below = [soles[i].point_below(feet[i].position_ankle, feet[i].rotation) for i in gait.standing]
    return footprints_of(gait.steps_ahead, soles, float(np.mean([point[2] for point in below])))
