"""``surefoot map``: all maps of a bench table, as pictures and as one page of HTML."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.families import PUSH_DURATION_S, stone_size
from surefoot.experiments.bench.ladders import BIP
from surefoot.experiments.html_page import page
from surefoot.experiments.maps.data import Spot, spots, word
from surefoot.experiments.maps.limits import ankle_stop_height, capture_curve, swing_limits
from surefoot.experiments.scenario.robots import robot_named
from surefoot.output_files import write_file
from surefoot.robot.feet import Support

_PUSHES = {"push": "one foot", "push-double": "two feet"}
_STONES = (
    "## Stones under the stance foot\n\n![Highest stone survived over the sole](map_stones.png)\n\n"
    "A box of {size} mm comes up under the sole in 0.3 s. The number is the highest one survived [mm]; + where the "
    "ladder ends or no posture reaches further, 'no' where not even the lowest was survived. No formula bounds stones; "
    "what gives out first is the ankle's frontal range: 'stop' is the height [mm] from which the ankle stands at its "
    "frontal stop while the CoM stays in place. A tile that hardly covers the sole is a stone that hardly lifts it.\n"
)
_PUSH_TEXT = (
    "## Pushes through the centre of mass\n\n![Largest impulse survived against the capture bound](map_pushes.png)\n\n"
    f"A constant force for {PUSH_DURATION_S:g} s. The line is J_cap(T), the greatest impulse that can be survived "
    "without a step and without angular momentum about G, with the true sole; the numbers are shares of it. Bars: only "
    "these directions were tried.\n"
)
_SWINGS = (
    "## Swings of the centre of mass\n\n![Amplitude over duration](map_swings.png)\n\n"
    "From rest to rest by a quintic. Above the dashed line the reference's own ZMP (whole body) leaves the sole, so no "
    "controller can follow exactly; in the grey its capture point leaves the sole: who stands there, stands by not "
    "following. Only marked points were run; a bar is the largest amplitude survived, + where the ladder ends.\n"
)


def write_maps(
    rows: Sequence[Mapping[str, Any]], manifest: Mapping[str, Any], out: Path, robot: str = BIP
) -> list[Path]:
    """Draw what the table holds and write map.html.

    Args:
        rows: of a bench table.
        manifest: what made it.
        out: an existing folder.
        robot: whose table it is, as a scenario names it.

    Returns:
        The files written, the report last.

    Raises:
        InvalidInput: the table holds nothing that a map shows.
        OSError: the folder cannot be written.
    """
    sections, names = [], []
    for name, text in (
        ("map_stones", _stones(rows, out, robot)),
        ("map_pushes", _pushes(rows, out, robot)),
        ("map_swings", _swings(rows, out, robot)),
    ):
        if text:
            sections.append(text)
            names.append(name)
    if not sections:
        raise InvalidInput("--bench", "its table", "holds nothing that a map shows", ["stone", "push", "swing"])
    text = "\n".join(["# Maps of survival\n", *sections, _origin(manifest)])
    report = out / "map.html"
    write_file(report, page(text, out))
    return [out / f"{name}.{kind}" for name in names for kind in ("png", "svg")] + [report]


def _stones(rows: Sequence[Mapping[str, Any]], out: Path, robot: str) -> str:
    from surefoot.experiments.plots.map_stones import draw_stone_map

    found = spots(rows, "stone")
    if not found:
        return ""
    support = Support(next(iter(found.values()))[0].support)
    every = [spot for mine in found.values() for spot in mine]
    size = stone_size(robot)
    stops = {spot.case: ankle_stop_height(spot.place, size, support, robot) for spot in every}
    draw_stone_map(found, robot_named(robot).feet[support.reference_foot].sole, stops, size, out, "map_stones")
    return _STONES.format(size=" x ".join(f"{1e3 * side:g}" for side in size)) + _table(found, 1e3, _digits(robot))


def _digits(robot: str) -> int:
    """Of a length in mm."""
    return 0 if robot == BIP else 1


def _pushes(rows: Sequence[Mapping[str, Any]], out: Path, robot: str) -> str:
    from surefoot.experiments.plots.map_pushes import directions, draw_push_map

    found = {title: by for family, title in _PUSHES.items() if (by := spots(rows, family))}
    if not found:
        return ""
    supports = {title: Support(next(iter(by.values()))[0].support) for title, by in found.items()}
    bounds = {title: capture_curve(supports[title], PUSH_DURATION_S, directions(), robot) for title in found}
    draw_push_map(found, bounds, out, "map_pushes")
    return _PUSH_TEXT + "".join(f"\nOn {title}, J / J_cap:\n\n{_table(by, 1.0, 3)}" for title, by in found.items())


def _swings(rows: Sequence[Mapping[str, Any]], out: Path, robot: str) -> str:
    from surefoot.experiments.plots.map_swings import draw_swing_map

    by_controller = spots(rows, "swing")
    if not by_controller:
        return ""
    every = [spot for found in by_controller.values() for spot in found]
    found: dict[str, dict[str, list[Spot]]] = {}
    for direction in dict.fromkeys(word(spot) for spot in every):
        found[direction] = {name: [s for s in mine if word(s) == direction] for name, mine in by_controller.items()}
    durations = np.array(sorted({spot.place[0] for spot in every}))
    across = np.linspace(durations.min() - 0.06, durations.max() + 0.06, 9)
    first = {word(spot): spot for spot in reversed(every)}
    limits = {d: swing_limits(first[d].axis, first[d].place[1], across, robot=robot) for d in found}
    draw_swing_map(found, limits, out, "map_swings")
    return _SWINGS + "\nLargest amplitude survived [mm]:\n\n" + _table(by_controller, 1e3, _digits(robot))


def _table(found: Mapping[str, Sequence[Spot]], factor: float, digits: int) -> str:
    cases = list(dict.fromkeys(spot.case for mine in found.values() for spot in mine))
    lines = [f"| | {' | '.join(cases)} |", "|---" * (len(cases) + 1) + "|"]
    for name, mine in found.items():
        by_case = {spot.case: spot for spot in mine}
        lines.append(f"| {name} | {' | '.join(_number(by_case.get(case), factor, digits) for case in cases)} |")
    return "\n" + "\n".join(lines) + "\n"


def _number(spot: Spot | None, factor: float, digits: int) -> str:
    if spot is None or math.isnan(spot.threshold):
        return "-"
    if spot.lowest is not None:
        return f"< {factor * spot.lowest:.{digits}f}"
    return f"{factor * spot.threshold:.{digits}f}{'+' if spot.at_top else ''}"


def _origin(manifest: Mapping[str, Any]) -> str:
    keys = ("arguments", "seeds", "cells", "commit", "versions", "survived")
    shown = {key: manifest[key] for key in keys if key in manifest}
    return f"\n## What made this\n\n```\n{json.dumps(shown, indent=1, default=str)}\n```\n"
