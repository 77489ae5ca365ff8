"""What a finished price list is written as: a page in Markdown, its waterfalls, and the same as JSON."""

import dataclasses
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.made_by import seeds_text, survived_text
from surefoot.experiments.bench.store import MANIFEST, read_json, read_table
from surefoot.experiments.bench.words import table_header, table_line
from surefoot.experiments.plots.waterfall import draw_waterfalls
from surefoot.experiments.price.losses import Price, prices
from surefoot.experiments.price.plan import ABOUT
from surefoot.experiments.price.words import COLUMNS, HOW, cells, tables, title, what_differs
from surefoot.output_files import write_file

PAGE, PICTURE, DATA = "price.md", "price", "price.json"


def read_price(folder: Path) -> tuple[list[Price], dict[str, Any]]:
    """The prices of a finished list, and what made them. Raises InvalidInput."""
    manifest = read_json(folder, MANIFEST)
    if ABOUT not in manifest:
        raise InvalidInput("--out", str(folder), "holds a bench, but no price list; take another folder")
    return prices(read_table(folder), manifest), manifest


def write_price(folder: Path) -> list[Path]:
    """Write page, pictures (png, svg) and JSON beside the table they are made from.

    Returns:
        The files, the page first.

    Raises:
        InvalidInput: there is no finished price list.
        OSError: the folder cannot be written.
    """
    found, manifest = read_price(folder)
    figures = manifest[ABOUT]["figures"]
    draw_waterfalls([(title(group[0], figures), group) for group in tables(found)], folder, PICTURE)
    write_file(folder / DATA, json.dumps([_plain(price) for price in found], indent=1, allow_nan=False) + "\n")
    write_file(folder / PAGE, price_page(found, manifest))
    return [folder / name for name in (PAGE, f"{PICTURE}.png", f"{PICTURE}.svg", DATA)]


def price_page(found: Sequence[Price], manifest: Mapping[str, Any]) -> str:
    """The page."""
    versions = ", ".join(f"{name} {version}" for name, version in sorted(manifest["versions"].items()))
    return "\n".join(
        (
            "# What each imperfection costs",
            "",
            f"Made by `{command_of(manifest)}` from commit `{str(manifest['commit'])[:12]}`; {manifest['cells']} "
            f"cells. {versions}.",
            "",
            seeds_text(manifest),
            "",
            survived_text(manifest),
            "",
            HOW,
            "",
            f"![From perfect to all imperfections together]({PICTURE}.png)",
            "",
            "## What is lost",
            "",
            *price_tables(found, manifest),
            "## What each imperfection is",
            "",
            *table_header("imperfection", "what differs"),
            *(table_line(name, text) for name, text in what_differs(manifest).items()),
            "",
        )
    )


def price_tables(found: Sequence[Price], manifest: Mapping[str, Any]) -> list[str]:
    """The tables alone, one a figure and controller."""
    lines = []
    for group in tables(found):
        what = title(group[0], manifest[ABOUT]["figures"])
        lines += [f"### {what[0].upper()}{what[1:]}", "", *table_header(*COLUMNS)]
        lines += [*(table_line(*cells(price)) for price in group), ""]
    return lines


def command_of(manifest: Mapping[str, Any]) -> str:
    """The command that made a price list."""
    asked = manifest[ABOUT]["request"]
    return " ".join(
        (
            "surefoot price",
            *(["--quick"] if asked["quick"] else []),
            f"--families {','.join(figure['family'] for figure in manifest[ABOUT]['figures'])}",
            f"--preset {asked['preset']} --estimator {asked['estimator']}",
            *([f"--imperfections {','.join(asked['imperfections'])}"] if asked["imperfections"] else []),
            f"--controllers {asked['controllers']}",
            f"--seeds {asked['seeds']} --first-seed {asked['first_seed']}",
            *(f"--set {change}" for change in asked["changes"]),
        )
    )


def _plain(price: Price) -> dict[str, Any]:
    return {
        name: None if isinstance(value, float) and math.isnan(value) else value
        for name, value in dataclasses.asdict(price).items()
    }
