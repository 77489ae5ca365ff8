"""Two controllers on the very same ground, side by side, at one press."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from surefoot.dashboard.messages.command_base import Command
from surefoot.dashboard.messages.commands import LoadScenario, ResetSettings, SetController, StartTwin


@dataclass(frozen=True)
class Duel:
    """A twin run.

    Attributes:
        title: how it is called.
        text: what it shows, and how it was chosen.
        scenario: name of a shipped one.
        changes: of the scenario, dotted path -> value.
        first, twin: who drives the two robots.
    """

    title: str
    text: str
    scenario: str
    changes: Mapping[str, Any]
    first: str
    twin: str

    def commands(self) -> tuple[Command, ...]:
        """What starts it, with the settings that scenario and controllers have by themselves."""
        scenario = LoadScenario(self.scenario, self.changes)
        return SetController(self.first), ResetSettings(), scenario, StartTwin(self.twin)


WALK_OVER_STONES = Duel(
    title="Walk over stones: one falls",
    text="Twelve steps with a stone of 25 mm under each: `two-part` makes them all, the twin `optimization` falls "
    "after the fifth. It is one draw of the stones (seed 3), chosen because the two differ: with seeds 0, 1 and 2 both "
    "complete the walk. The bench tells how often each does",
    scenario="walk_stones",
    changes={"reference.steps": 12, "stones_under_steps.height_m": 0.025, "stones_under_steps.seed": 3},
    first="two-part",
    twin="optimization",
)
