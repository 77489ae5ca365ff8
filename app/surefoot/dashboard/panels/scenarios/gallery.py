"""The shipped scenarios as a gallery: a card each, what it shows in one line, the paper's figures first."""

from dataclasses import dataclass
from html import escape

import viser

from surefoot.dashboard.messages.commands import LoadScenario
from surefoot.dashboard.messages.shown_robot import FIRST_ROBOT
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.panels.scenarios.duels import WALK_OVER_STONES, Duel
from surefoot.dashboard.scene.twin_scene import BESIDE
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.experiments.scenario.scenario import shipped_scenarios

_FIGURES = ("paper_figure1_stone", "paper_swing_35", "paper_swing_45", "paper_push_beyond", "paper_delta_reference")
_TITLES = {
    "paper_figure1_stone": "Figure 1: a stone under the sole",
    "paper_swing_35": "Figures 5 to 9: the inward swing",
    "paper_swing_45": "A second inward swing",
    "paper_push_beyond": "A push beyond the capture point",
    "paper_delta_reference": "A reference for delta_P",
    "stand_left": "Stand on the left foot",
    "stand_double": "Stand on both feet",
    "stone_outer_edge": "Stone under the outer edge",
    "swing_inward": "Fast inward swing",
    "push_left": "Push to the left",
    "walk_flat": "Walk on flat ground",
    "walk_tiles": "Walk over tiles",
    "walk_stones": "Walk over stones",
    "step_onto_stone": "Step onto a stone",
    "push_and_step": "A push caught with a step",
}
_WALKS = "Walks and steps"
_OTHER = "{robot} stays. Stones, pushes, swings and steps were chosen for Bip and are taken in proportion to it."
_DUELS = {_WALKS: (WALK_OVER_STONES,)}


@dataclass(frozen=True)
class ScenarioCard:
    """One scenario.

    Attributes:
        name: how it is loaded.
        title: how it is called.
        text: what it shows, one line.
    """

    name: str
    title: str
    text: str


def gallery() -> dict[str, tuple[ScenarioCard, ...]]:
    """Group -> its scenarios."""
    exhibits = {name: _exhibit(name, path.read_text(encoding="utf-8")) for name, path in shipped_scenarios().items()}
    exhibits = {"stand_left": exhibits.pop("stand_left"), **exhibits}  # where everybody begins
    groups: dict[str, list[ScenarioCard]] = {"The paper": [exhibits[name] for name in _FIGURES if name in exhibits]}
    for name, exhibit in exhibits.items():
        if name not in _FIGURES:
            groups.setdefault(_group(name), []).append(exhibit)
    first = ("The paper", "First steps", _WALKS, "On other ground")
    order = [*first, *(group for group in groups if group not in first)]
    return {group: tuple(groups[group]) for group in order if groups.get(group)}


def scenario_texts() -> dict[str, str]:
    """Name of each scenario -> what it shows, in the order of the gallery."""
    return {card.name: card.text for cards in gallery().values() for card in cards}


def _group(name: str) -> str:
    if name.startswith("paper_predict"):
        return "Where the ZMP leaves the sole"
    if name.startswith("ablation"):
        return "Ablation"
    if name.startswith(("walk_", "step_")) or name == "push_and_step":
        return _WALKS
    return "On other ground" if name.startswith("ground_") else "First steps"


def _exhibit(name: str, text: str) -> ScenarioCard:
    title = _TITLES.get(name) or name.split("_", 1)[-1].replace("_", " ").capitalize()
    return ScenarioCard(name, title, text.partition("\n")[0].lstrip("# ").rstrip("."))


class GalleryPanel(Panel):
    """Cards with a button each; and what holds of them with another robot.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        context.gui.add_markdown("<small>A press loads the scenario and starts it; controller and gains stay.</small>")
        self._note = context.gui.add_markdown("", visible=False)
        self.show(context.newest())
        _add_cards(context)

    def show(self, snapshot: Snapshot) -> None:
        """Say whose the scenarios' sizes are, where another robot is active."""
        title, other = snapshot.robot.title, snapshot.robot.key != FIRST_ROBOT
        if other:
            set_changed(self._note, content=f"<small>{_OTHER.format(robot=escape(title))}</small>")
        set_changed(self._note, visible=other)


def _add_cards(context: PageContext) -> None:
    """Add them by groups; what runs with a twin before the others of its group."""
    gui, send = context.gui, context.send
    for i, (group, cards) in enumerate(gallery().items()):
        with gui.add_folder(group, expand_by_default=i < 3):
            for duel in _DUELS.get(group, ()):
                _add_duel(context, duel)
            for card in cards:
                load = gui.add_button(card.title, hint=f"load scenario {card.name}", color="gray")
                load.on_click(lambda _, name=card.name: send(LoadScenario(name)))
                gui.add_markdown(f"<small>{card.text}.</small>")


def _add_duel(context: PageContext, duel: Duel) -> None:
    hint = (
        f"twin run of {duel.first} and {duel.twin}, with the settings that scenario and controllers have by themselves"
    )
    start = context.gui.add_button(duel.title, hint=hint, color="violet")

    @start.on_click
    def _(event: viser.GuiEvent) -> None:
        context.arrange_twin(BESIDE, event.client)
        for command in duel.commands():
            context.send(command)

    context.gui.add_markdown(f"<small>{duel.text}.</small>")
