"""What a newcomer reads first, and the guide: ZMP, delta_P, the law, estimation, and where each equation is."""

import base64
import json
import re
import tomllib
from collections.abc import Iterator
from html import escape
from pathlib import Path

from surefoot.dashboard.panels.panel import PageContext
from surefoot.equation_ledger import TITLES
from surefoot.resources import help_text, resource_folder


def add_first_words(context: PageContext) -> None:
    """Add both texts, the second one folded up."""
    context.gui.add_markdown(help_text("start"))
    with context.gui.add_folder("Mouse, timeline, words", expand_by_default=False):
        context.gui.add_markdown(help_text("signs"))


SECTIONS = {
    "zmp": "What is the ZMP?",
    "delta": "δ_P: the total rate of angular momentum",
    "law": "The two-part law",
    "capture": "The capture bound",
    "state_estimation": "Why tilt is observable and yaw is not",
}
_MARK = "$$ "
_PICTURE = re.compile(r"!\[([^]]*)\]\(([^)]+\.png)\)")


def add_guide(context: PageContext) -> None:
    """Add a folder for each section, and the table equation -> file."""
    gui = context.gui
    for name, title in SECTIONS.items():
        with gui.add_folder(title, expand_by_default=False):
            for is_equation, text in pieces(name):
                if is_equation:
                    gui.add_html(equation_html(text))
                else:
                    gui.add_markdown(with_pictures(text), image_root=_guide())
    with gui.add_folder("Equation → file", expand_by_default=False):
        gui.add_html(owners_html(owned()))


def pieces(section: str) -> Iterator[tuple[bool, str]]:
    """The text of a section in order: markdown, and names of equations (lines that begin with ``$$``)."""
    text = (_guide() / f"{section}.md").read_text(encoding="utf-8")
    for paragraph in text.strip().split("\n\n"):
        yield (True, paragraph[len(_MARK) :].strip()) if paragraph.startswith(_MARK) else (False, paragraph)


def with_pictures(text: str) -> str:
    """Markdown of the guide with its pictures inside, as their files are; viser would make them anew, and larger."""

    def inside(match: re.Match[str]) -> str:
        data = base64.b64encode((_guide() / match[2]).read_bytes()).decode()
        return f"![{match[1]}](data:image/png;base64,{data})"

    return _PICTURE.sub(inside, text)


def equations() -> dict[str, dict]:
    """All equations of the guide: name -> lines, words, numbers in the paper."""
    return tomllib.loads((_folder() / "equations.toml").read_text(encoding="utf-8"))


def picture(name: str) -> str:
    """An equation as it was drawn: SVG in the colour of the text around it."""
    return (_folder() / f"{name}.svg").read_text(encoding="utf-8").strip()


def owned() -> dict[int, list[tuple[str, str]]]:
    """Who owns which equation, as it was when the equations were drawn: number -> (file, function)."""
    listed = json.loads((_folder() / "owners.json").read_text(encoding="utf-8"))
    return {int(number): [(file, name) for file, name in places] for number, places in listed.items()}


def equation_html(name: str) -> str:
    """The picture with its number in the paper."""
    numbers = equations()[name]["numbers"]
    apart = " – " if len(numbers) > 2 else ", "
    shown = apart.join(f"({number})" for number in (numbers if len(numbers) <= 2 else (numbers[0], numbers[-1])))
    return (
        f'<div data-equation="{name}" style="display:flex;align-items:center;gap:6px;padding:2px 10px 8px 16px;'
        f'overflow-x:auto"><div style="flex:none;line-height:0">{picture(name)}</div>'
        f'<span style="margin-left:auto;font-size:12px;opacity:0.7;white-space:nowrap">{shown}</span></div>'
    )


def owners_html(places: dict[int, list[tuple[str, str]]]) -> str:
    """The table: number, meaning, file and function of each owner."""
    cell = "padding:3px 4px;vertical-align:top;border-top:1px solid #8884"
    rows = "".join(
        f'<tr><td style="{cell}">({number})</td><td style="{cell}">{escape(TITLES[number])}'
        + "".join(
            f'<div style="font-family:monospace;font-size:11px;opacity:0.8;overflow-wrap:anywhere">{escape(file)}<br>'
            f"&nbsp;&nbsp;{escape(name)}</div>"
            for file, name in owners
        )
        + "</td></tr>"
        for number, owners in places.items()
    )
    return (
        '<div style="padding:2px 8px;font-size:12px;line-height:1.35">The numbers are the paper\'s. Each function '
        'says in its docstring which equations are its own.<table style="border-collapse:collapse;margin-top:4px">'
        f'<tr><th style="text-align:left">Eq.</th><th style="text-align:left">Meaning, file, function</th></tr>{rows}'
        "</table></div>"
    )


def _guide() -> Path:
    return resource_folder("static") / "help" / "guide"


def _folder() -> Path:
    return resource_folder("static") / "help" / "equations"
