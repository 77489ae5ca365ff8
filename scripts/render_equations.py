"""Draw the guide's equations: static/help/equations/*.svg and owners.json, from equations.toml and the docstrings.

    python scripts/render_equations.py

Each picture is one path in the colour of the text around it, so that it is readable on dark and on light pages. What it
was drawn from stands in it; a test holds that against equations.toml, and the owners against the docstrings.
"""

import json
import tomllib
from html import escape
from pathlib import Path

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path as Outline
from matplotlib.textpath import TextPath

from surefoot.equation_ledger import owned_where

FOLDER = Path(__file__).resolve().parent.parent / "static" / "help" / "equations"
SIZE_PX, GAP_PX, EDGE_PX = 14.0, 9.0, 1.0
FONT = FontProperties(family="DejaVu Sans", math_fontfamily="cm")
UNITS = 20  # of the path, a pixel
LETTERS = {Outline.MOVETO: "m", Outline.LINETO: "l", Outline.CURVE3: "q", Outline.CURVE4: "c"}


def outline(line: str, top: float) -> tuple[str, float, float]:
    """Path data of one line whose upper edge lies at ``top``, its width, and where its lower edge lies [px]."""
    path = TextPath((0.0, 0.0), f"${line}$", size=SIZE_PX, prop=FONT, usetex=False)
    box = path.get_extents()
    words, here, begun = [], np.zeros(2), np.zeros(2)
    for points, code in path.iter_segments(simplify=False, curves=True):
        places = np.round(UNITS * (points.reshape(-1, 2) * (1.0, -1.0) + (0.0, top + box.y1))).astype(int)
        if code == Outline.CLOSEPOLY:
            words.append("z")
            here = begun
            continue
        words.append(LETTERS[code] + " ".join(f"{x} {y}" for x, y in (places - here).astype(int)))
        here = places[-1]
        begun = here if code == Outline.MOVETO else begun
    return "".join(words).replace(" -", "-"), float(box.x1), top + float(box.height)


def picture(lines: list[str], words: str) -> str:
    """The SVG of an equation."""
    data, width, bottom = "", 0.0, EDGE_PX - GAP_PX
    for line in lines:
        drawn, right, bottom = outline(line, bottom + GAP_PX)
        data += f'<path fill="currentColor" d="{drawn}"/>'
        width = max(width, right)
    w, h = width + EDGE_PX, bottom + EDGE_PX
    box = f"0 0 {UNITS * w:.0f} {UNITS * h:.0f}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{w:.0f}" height="{h:.0f}" viewBox="{box}" '
        f'role="img" aria-label="{escape(words)}" data-lines="{escape(json.dumps(lines))}">'
        f"{data}</svg>\n"
    )


def main() -> None:
    """Draw all, and write who owns which equation."""
    equations = tomllib.loads((FOLDER / "equations.toml").read_text(encoding="utf-8"))
    for old in FOLDER.glob("*.svg"):
        old.unlink()
    for name, equation in equations.items():
        (FOLDER / f"{name}.svg").write_text(picture(equation["lines"], equation["words"]), encoding="utf-8")
    text = json.dumps(owned_where(), indent=1) + "\n"
    (FOLDER / "owners.json").write_text(text, encoding="utf-8")
    print(f"{len(equations)} equations, {FOLDER}")


if __name__ == "__main__":
    main()
