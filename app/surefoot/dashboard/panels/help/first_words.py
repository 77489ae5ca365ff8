"""What a newcomer reads first, and what the signs and words of the page mean."""

from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.ui.help_text import help_text


def add_first_words(context: PageContext) -> None:
    """Add both texts, the second one folded up."""
    context.gui.add_markdown(help_text("start"))
    with context.gui.add_folder("Mouse, timeline, words", expand_by_default=False):
        context.gui.add_markdown(help_text("signs"))
