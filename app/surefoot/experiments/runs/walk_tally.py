"""What a walk came to: steps, way, speed and work."""

import math
from typing import Any

import numpy as np

from surefoot.gait.progress import Phase
from surefoot.gait.recovering_walk import RecoveringWalk
from surefoot.gait.repeated_walk import RepeatedWalk
from surefoot.gait.walk import Walk
from surefoot.robot.description import BASE_DOFS
from surefoot.simulation.loop import TickResult
from surefoot.simulation.physics import TIMESTEP_S

STANDS_S = 2.0  # so long a robot stands after its last step before the walk counts as completed
_SHORTEST_M = 0.1  # over less than that a cost of transport says nothing


class WalkTally:
    """Running figures of a walk.

    Args:
        walk: the gait that walks.
    """

    def __init__(self, walk: Walk) -> None:
        self._walk = walk
        self._first: np.ndarray | None = None
        self._last = np.zeros(2)
        self._weight_n = self._work_j = self._time_s = 0.0

    def add(self, result: TickResult) -> None:
        """One tick."""
        terms = result.terms
        if terms is None:
            return
        self._last = terms.position_com_in_world[:2].copy()
        if self._first is None:
            self._first = self._last
        self._time_s, self._weight_n = terms.state.time_s, terms.mass_kg * terms.gravity
        if self._walk.phase not in (Phase.WAITING, Phase.STANDING):
            power = np.abs(result.applied * terms.state.v[BASE_DOFS:])
            self._work_j += float(np.add.reduce(power)) * TIMESTEP_S

    def summary(self, *, fell: bool) -> dict[str, Any]:
        """The walk's part of ``surefoot run --json``.

        ``energy_j`` counts what each motor gives and what it takes, |torque x velocity|, from the first shift of the
        weight to the last, emergency steps included; ``cost_of_transport`` is that per weight and distance.
        """
        walk, timing = self._walk, self._walk.timing
        stands = walk.phase is Phase.STANDING
        walked_s = (walk.began_s if stands else self._time_s) - timing.start_s
        again = walk.steps_again if isinstance(walk, RepeatedWalk) else 0
        planned, made = len(walk.footsteps), walk.made
        if isinstance(walk, RecoveringWalk):
            again += walk.steps_kept
            planned, made = planned - walk.recovery_steps_planned, made - walk.recovery_steps
        way = 0.0 if self._first is None else math.hypot(*(self._last - self._first))
        return {
            "steps_planned": planned + again,
            "steps_made": made,
            "walk_completed": stands and not again and not fell and self._time_s - walk.began_s >= STANDS_S,
            "distance_m": way,
            "mean_speed_m_s": way / walked_s if walked_s > 0.0 else 0.0,
            "energy_j": self._work_j,
            "cost_of_transport": self._work_j / (self._weight_n * way) if way > _SHORTEST_M else None,
        }
