"""What a gait is to the loop."""

from typing import Protocol

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference


class Gait(Protocol):
    """Decides the wanted kappa of every tick from where the robot is and what its feet feel; it may remember."""

    @property
    def standing(self) -> tuple[int, ...]:
        """The feet that are to keep their load now: not one that swings, nor one whose load is being taken away."""
        ...

    def tick(self, terms: DynamicsTerms, sensing: FootSensing) -> TaskReference:
        """The wanted kappa now."""
        ...
