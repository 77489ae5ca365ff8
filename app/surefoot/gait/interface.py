"""What a gait is to the loop."""

from typing import Protocol

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.footsteps import Footstep
from surefoot.gait.progress import Progress
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference


class Gait(Protocol):
    """Decides the wanted kappa of every tick from where the robot is and what its feet feel; it may remember."""

    @property
    def standing(self) -> tuple[int, ...]:
        """The feet that are to keep their load now: not one that swings, nor one whose load is being taken away."""
        ...

    @property
    def steps_ahead(self) -> tuple[Footstep, ...]:
        """The next steps, at most 4; one that is being made is the first of them."""
        ...

    @property
    def plan_ahead(self) -> np.ndarray:
        """ZMP and capture point of the steps ahead, now first: (n, 4) x and y of either in world [m]; (0, 4): none."""
        ...

    @property
    def progress(self) -> Progress:
        """How far it has come."""
        ...

    def tick(self, terms: DynamicsTerms, sensing: FootSensing, held: TaskReference) -> TaskReference:
        """The wanted kappa now; ``held`` is that of a robot that lifts no foot."""
        ...
