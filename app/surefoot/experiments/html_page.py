"""The report as one page of HTML that needs no other file: the pictures are inside."""

import base64
import re
from html import escape
from pathlib import Path

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 64rem; margin: 2rem auto; padding: 0 1rem; color: #1b1b1b;
  background: #fff; }
h1, h2, h3 { line-height: 1.2; margin-top: 2.2em; }
img { display: block; width: 100%; max-width: 46rem; margin: 1rem auto 0.3rem; height: auto; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: 0.86rem; }
th, td { border: 1px solid #d0d0d0; padding: 0.3em 0.55em; text-align: left; vertical-align: top; }
th { background: #f1eee6; position: sticky; top: 0; }
code, pre { font-size: 0.86rem; background: #f5f5f5; }
pre { padding: 0.8em; overflow-x: auto; }
"""


def page(markdown: str, folder: Path) -> str:
    """The page; every PNG that the text links is read from ``folder`` and put into it."""
    from markdown_it import MarkdownIt

    body = MarkdownIt("commonmark").enable("table").render(markdown)
    body = re.sub(r'src="([\w-]+\.png)"', lambda found: f'src="{_embedded(folder / found[1])}"', body)
    body = body.replace("<table>", '<div class="scroll"><table>').replace("</table>", "</table></div>")
    title = markdown.partition("\n")[0].lstrip("# ")
    return (
        f'<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{escape(title)}</title>\n'
        f"<style>{_STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )


def _embedded(picture: Path) -> str:
    return f"data:image/png;base64,{base64.b64encode(picture.read_bytes()).decode('ascii')}"
