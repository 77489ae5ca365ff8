"""The gallery: a card per scenario, the paper's figures first."""

from surefoot.dashboard.messages.commands import LoadScenario
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.scenarios.catalogue import gallery


def add_gallery(context: PageContext) -> None:
    """Add cards with a button each."""
    gui, send = context.gui, context.send
    gui.add_markdown("<small>A press loads the scenario and starts it; controller and gains stay.</small>")
    for i, (group, cards) in enumerate(gallery().items()):
        with gui.add_folder(group, expand_by_default=i < 2):
            for card in cards:
                load = gui.add_button(card.title, hint=f"load scenario {card.name}", color="gray")
                load.on_click(lambda _, name=card.name: send(LoadScenario(name)))
                gui.add_markdown(f"<small>{card.text}.</small>")
