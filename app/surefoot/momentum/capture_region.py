"""K_0, K_1, K_2: where the capture point may be so that the robot can come to rest without a step, with one, with two.

A linear pendulum of natural frequency omega whose ZMP p is in the sole S has xi' = omega (xi - p). Backwards over a
time T that reads xi(0) = e xi(T) + (1 - e) p_mean with e = e^(-omega T), and the mean of the ZMP is anywhere in S. So
every point of (1 - e) S (+) e K leads into K, and no other ((+) is the Minkowski sum). With K the hull of both soles
after a foot has been set down, over all places that it can reach, this is K_1. K_0 is the support itself.

Angular momentum and changes of height, which move the capture point too, are not counted. The one-dimensional case is
in Koolen et al., "Capturability-based analysis and control of legged locomotion", Int. J. of Robotics Research 31(9),
2012.
"""

import math

from surefoot.geometry.polygon import ConvexPolygon, convex_hull, minkowski_sum
from surefoot.record import record


@record
class StepReach:
    """What a step can do.

    Attributes:
        places: where the point below the ankle can be set down, relative to that of the foot that stands [m]; axes of
            the soles.
        sole: of the foot that lands, relative to the point below its ankle [m].
        landing_s: time until it stands [s].
    """

    places: ConvexPolygon
    sole: ConvexPolygon
    landing_s: float


def led_into(region: ConvexPolygon, support: ConvexPolygon, omega: float, time_s: float) -> ConvexPolygon:
    """Where the capture point must be so that a ZMP in the support leads it into a region within a time.

    Args:
        region: [m].
        support: what the ZMP can use meanwhile [m], same axes.
        omega: natural frequency [rad/s].
        time_s: [s]; 0: the region itself.
    """
    left = math.exp(-omega * time_s)
    if left == 1.0:
        return region
    return minkowski_sum(_stretched(support, 1.0 - left), _stretched(region, left))


def capture_region_1(stance: ConvexPolygon, step: StepReach, omega: float) -> ConvexPolygon:
    """K_1 of a robot on one foot whose other foot is in the air: (1 - e) S (+) e hull(S, R (+) F).

    The union of hull(S, l + F) over all places l of a convex R is that hull.

    Args:
        stance: S, the sole that stands, relative to the point below its ankle [m].
        step: of the other foot.
        omega: natural frequency [rad/s].
    """
    landed = minkowski_sum(step.places, step.sole)
    both = convex_hull([*stance.vertices.tolist(), *landed.vertices.tolist()])
    return led_into(both, stance, omega, step.landing_s)


def capture_region_2(stance: ConvexPolygon, step: StepReach, second: StepReach, omega: float) -> ConvexPolygon:
    """Where two steps, the second begun as soon as the first has landed, are enough: (1 - e) S (+) e (R (+) K_1').

    K_2 is this together with K_1.

    Args:
        stance: the sole that stands, relative to the point below its ankle [m].
        step: of the other foot.
        second: of the foot that stands first, relative to the one that has landed.
        omega: natural frequency [rad/s].
    """
    after = capture_region_1(step.sole, second, omega)
    return led_into(minkowski_sum(step.places, after), stance, omega, step.landing_s)


def _stretched(polygon: ConvexPolygon, factor: float) -> ConvexPolygon:
    """About the origin."""
    return ConvexPolygon(factor * polygon.vertices)
