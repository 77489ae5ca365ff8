"""The gallery: a card per scenario, the paper's figures first."""

from collections.abc import Mapping, Sequence

import viser

from surefoot.dashboard.messages.commands import LoadScenario
from surefoot.dashboard.panels.scenarios.catalogue import ScenarioCard
from surefoot.dashboard.ui.setting_widgets import Send


class GalleryPanel:
    """Cards with a button each.

    Args:
        gui: where to add them.
        send: takes the commands.
        groups: group -> its scenarios.
    """

    def __init__(self, gui: viser.GuiApi, send: Send, groups: Mapping[str, Sequence[ScenarioCard]]) -> None:
        gui.add_markdown("<small>A press loads the scenario and starts it; controller and gains stay.</small>")
        for i, (group, exhibits) in enumerate(groups.items()):
            with gui.add_folder(group, expand_by_default=i < 2):
                for exhibit in exhibits:
                    load = gui.add_button(exhibit.title, hint=f"load scenario {exhibit.name}", color="gray")
                    load.on_click(lambda _, name=exhibit.name: send(LoadScenario(name)))
                    gui.add_markdown(f"<small>{exhibit.text}.</small>")
