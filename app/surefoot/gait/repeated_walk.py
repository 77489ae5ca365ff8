"""A walk that is made several times: it stops, stands, and walks on by itself."""

from collections.abc import Sequence

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.footsteps import Footstep, Pace, StepTiming
from surefoot.gait.progress import Phase
from surefoot.gait.walk import Walk
from surefoot.robot.description import RobotDescription
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference

_ROUNDING_S = 1e-9  # times are sums of ticks


class RepeatedWalk(Walk):
    """Starts, walks, stops and stands, again and again; steered in between, it goes on with the pace it was given.

    Args:
        robot, posture, timing, pace: as of a walk.
        footsteps: of the first walk; the others have as many.
        walks: how many.
        rest_s: how long it stands, from the end of one weight shift to the start of the next [s].

    Attributes:
        steps_again: steps of the walks that are still to be started.
    """

    def __init__(
        self,
        robot: RobotDescription,
        posture: TaskReference,
        footsteps: Sequence[Footstep],
        timing: StepTiming,
        *,
        pace: Pace,
        walks: int,
        rest_s: float,
    ) -> None:
        super().__init__(robot, posture, footsteps, timing, pace=pace)
        self._steps, self._rest_s = len(footsteps), rest_s
        self._stands_since_s: float | None = None
        self.steps_again = (walks - 1) * self._steps

    def tick(self, terms: DynamicsTerms, sensing: FootSensing, held: TaskReference) -> TaskReference:
        """As of a walk; one that has stood long enough first gets its next steps."""
        now = terms.state.time_s
        since_s = self._stands_since_s
        if since_s is not None and now - since_s >= self._rest_s - _ROUNDING_S:
            self._walk_on(terms)
        reference = super().tick(terms, sensing, held)
        if self.phase is not Phase.STANDING:
            self._stands_since_s = None
        elif since_s is None:
            self._stands_since_s = now
        return reference

    def _walk_on(self, terms: DynamicsTerms) -> None:
        """Get the next steps, where there are some."""
        if self.steps_again:
            self.steps_again -= self._steps
            self.steer(self.pace, self._steps)

    def stop(self) -> None:
        """As of a walk, and for good."""
        self.steps_again = 0
        super().stop()
