"""Whether a foot has landed, by what it feels, and whether it has lost the ground again."""

from surefoot.gait.scale import BIP, GaitScale

# Found by trial, Bip over stones of 30 mm (seeds 400 to 413); not searched for further. Bip's, as all here
TOUCH_N = 40.0  # a swing foot that feels more has met something
TOUCH_S = 0.0065  # and has landed when it feels that for so long: it may have grazed the edge of a stone
TOUCH_FROM = 0.5  # share of the swing before which it cannot
LOOSE_N = 15.0  # a foot that has landed and feels less has bounced: it goes on down, and carries nothing
LOOSE_SPEED_M_S, LOOSE_ACCELERATION = 0.3, 3.0  # it goes down ever faster, up to that speed


class Touchdown:
    """Follows the foot that lands; it is asked in every tick and remembers.

    Args:
        landing_speed_m_s: downwards, where the ground is expected.
        scale: of the robot.
    """

    def __init__(self, landing_speed_m_s: float, scale: GaitScale = BIP) -> None:
        self._landing_speed, self._scale = landing_speed_m_s, scale
        self._touch_n, self._loose_n = TOUCH_N * scale.force, LOOSE_N * scale.force
        self._free_s = 0.0  # when the foot in the air felt nothing for the last time
        self._lost_s: float | None = None

    def has_landed(self, now: float, force_n: float, share: float) -> bool:
        """Whether the foot in the air stands now.

        Args:
            now: time [s].
            force_n: along its sole's normal [N].
            share: of the swing that is over.
        """
        if share <= TOUCH_FROM or force_n <= self._touch_n:
            self._free_s = now
        return now - self._free_s > TOUCH_S * self._scale.time

    def has_bounced(self, now: float, force_n: float, other_n: float) -> bool:
        """Whether the foot that has landed last stands no more.

        Args:
            now: time [s].
            force_n: along its sole's normal [N].
            other_n: likewise of the other foot.
        """
        loose = force_n < self._loose_n < other_n
        self._lost_s = None if not loose else now if self._lost_s is None else self._lost_s
        return loose

    def descent_m_s(self, now: float) -> float:
        """How fast a foot that has bounced goes down."""
        since_s = 0.0 if self._lost_s is None else now - self._lost_s
        gained = LOOSE_ACCELERATION * self._scale.acceleration * since_s
        return min(self._landing_speed + gained, LOOSE_SPEED_M_S * self._scale.speed)
