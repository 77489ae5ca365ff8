"""The page about a finished bench, in Markdown: made from its ranking and manifest alone, so that it can be made again.

What stands in it besides numbers says what was measured and how; who won, and by how much, is left to the tables. How
thresholds and shares are written is the same here and on the terminal.
"""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from surefoot.experiments.bench.belief_table import beliefs_told
from surefoot.experiments.bench.goal_table import goals_reached
from surefoot.experiments.bench.ladders import BIP
from surefoot.experiments.bench.made_by import made_by, robot_of
from surefoot.experiments.bench.share_table import walks_completed, walks_ended
from surefoot.experiments.bench.statistics import share_interval
from surefoot.experiments.bench.store import MANIFEST, RANKING, read_json
from surefoot.experiments.bench.walk_families import MEANING as WALK_MEANING
from surefoot.experiments.bench.walk_pushes import pushes_survived
from surefoot.experiments.bench.words import (
    MARKS,
    number_text,
    spread_text,
    table_header,
    table_line,
    threshold_number,
    unit_text,
)

REFUSED = "refused"  # by the planner, whatever the controller


def threshold_text(
    mean: float | None, worst: float | None, *, at_top: bool, unit: str, lowest: float | None = None
) -> str:
    """Mean and least of a family's thresholds [``unit``]; a plus where some lie at the top of the ladder.

    ``lowest``: what those lie below that are 0 because nothing was survived.
    """
    if not (_known(mean) and _known(worst)):
        return REFUSED
    middle, least = (threshold_number(value, unit, lowest) for value in (mean, worst))
    return f"{middle}{'+' if at_top else ''} ({least})"


def range_text(
    median: float | None, low: float | None, high: float | None, unit: str, lowest: float | None = None
) -> str:
    """A case's median over seeds, and its range where there is one [``unit``]; ``lowest`` as of a family."""
    if not (_known(median) and _known(low) and _known(high)):
        return REFUSED
    return spread_text(*(threshold_number(value, unit, lowest) for value in (median, low, high)))


def share_text(count: int, of: int, cases: int) -> str:
    """A share with its 95 % interval, the trials being seeds of some cases."""
    if not of:
        return "-"
    low, high = share_interval(count, of, cases)
    return f"{count}/{of} [{low:.2f}, {high:.2f}]"


def score_text(score: float, interval: Sequence[float]) -> str:
    """A score, or a difference of two, with its interval."""
    return f"{score:.3f} [{interval[0]:.3f}, {interval[1]:.3f}]"


INTERVALS_OF_SHARES = (
    "Intervals are of 95 % and over the cases, as if these were a sample of disturbances of their kind; seeds of "
    "one case are near copies and add no trials of their own. Of a share: Wilson's, with as many trials as there "
    "are cases."
)
INTERVALS = (
    f"{INTERVALS_OF_SHARES} Of a score: 10 000 resamples of the cases within each family, each case with all its seeds "
    "and for all controllers at once. An interval of 'behind the first' that reaches 0 says that the order may be "
    "chance."
)


def _known(value: float | None) -> bool:
    return value is not None and not math.isnan(value)


_MEANING = {
    "swing": "amplitude of a rest-to-rest swing of the CoM",
    "stone": "height of a stone that rises under the sole",
    "landing": "height of a stone that the robot is dropped on",
    "push": "impulse through the CoM, one foot",
    "push-double": "impulse through the CoM, two feet",
    "trunk": "impulse on the trunk",
    "stone-push": "impulse while an 8 mm stone is under the sole",
    "slope": "slope stood on from the start",
    "tilt": "slope that the ground tilts to under the robot",
    "stand": "time stood, nothing happens",
}

Family = Mapping[str, Any]


def read_bench(folder: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Ranking and manifest of a finished bench. Raises InvalidInput."""
    return read_json(folder, RANKING), read_json(folder, MANIFEST)


def bench_page(ranking: Mapping[str, Any], manifest: Mapping[str, Any]) -> str:
    """The page: what made it, the families, the goals, who is best where, every case."""
    families = _by_family(ranking["families"])
    names = [entry["controller"] for entry in ranking["ranking"]] or list(next(iter(families.values())))
    return "\n".join(
        (
            "# What each controller survives",
            "",
            *made_by(manifest),
            "",
            *goals_reached(ranking, manifest),
            *_means(names, families, ranking),
            *_of_another_robot(manifest),
            "",
            *_goals(names, families, manifest),
            "",
            *(_best(names, families) if len(names) > 1 else ()),
            *walks_completed(ranking.get("shares", [])),
            *pushes_survived(ranking.get("walk_pushes", [])),
            *walks_ended(ranking.get("endings", [])),
            *beliefs_told(ranking.get("beliefs", [])),
            *_spread(names, families, manifest["seeds"]),
            *_cases(names, families),
            "",
        )
    )


def goals_table(ranking: Mapping[str, Any]) -> str:
    """The short table: goals reached in every family that has them, best controller first."""
    names = [entry["controller"] for entry in ranking["ranking"]]
    return "\n".join(_goals(names, _by_family(ranking["families"]), {})[4:])


def means_table(ranking: Mapping[str, Any]) -> str:
    """The table of what is survived in every family, with the scores, best controller first."""
    names = [entry["controller"] for entry in ranking["ranking"]]
    lines = _means(names, _by_family(ranking["families"]), ranking)[2:]
    return "\n".join(lines[: lines.index("")])


def _by_family(entries: Sequence[Family]) -> dict[str, dict[str, Family]]:
    found: dict[str, dict[str, Family]] = {}
    for entry in entries:
        found.setdefault(entry["family"], {})[entry["controller"]] = entry
    return found


def _means(names: Sequence[str], families: Mapping[str, Mapping[str, Family]], ranking: Mapping[str, Any]) -> list[str]:
    lines = [
        "## Largest survived, mean over cases (least of any case and seed)",
        "",
        *table_header("family", "what grows", "unit", *names),
    ]
    for family, of in families.items():
        unit = next(iter(of.values()))["unit"]
        cells = [
            threshold_text(
                entry["mean"], entry["worst"], at_top=bool(entry["at_top"]), unit=unit, lowest=entry.get("lowest")
            )
            for entry in (of[name] for name in names)
        ]
        lines.append(table_line(family, {**_MEANING, **WALK_MEANING}.get(family, ""), unit_text(unit), *cells))
    if len(names) == 1:  # the best of all, of whom there is one
        return [*lines, "", MARKS, "", INTERVALS_OF_SHARES]
    scores = [f"**{score_text(entry['score'], entry['score_95'])}**" for entry in ranking["ranking"]]
    behind = [score_text(entry["behind"], entry["behind_95"]) for entry in ranking["ranking"][1:]]
    lines += [
        table_line("**score**", "", "", *scores),
        table_line("behind the first", "", "", "", *behind),
        "",
        f"Score: threshold / best threshold of all, mean over cases, then over families. {MARKS}",
        "",
        INTERVALS,
    ]
    return lines


def _of_another_robot(manifest: Mapping[str, Any]) -> list[str]:
    """What is to be said where sizes are named that are Bip's."""
    if robot_of(manifest) == BIP:
        return []
    return ["", "Sizes in the words of a family (8 mm, 10 cm) are Bip's; this robot's are in proportion to it."]


def _goals(
    names: Sequence[str], families: Mapping[str, Mapping[str, Family]], manifest: Mapping[str, Any]
) -> list[str]:
    others = "" if robot_of(manifest) == BIP else " for Bip, here in proportion to the sole's width"
    lines = [
        "## Goals reached [95 % interval of the share]",
        "",
        "Goals: every swing whose capture point stays inside the sole, stones and landings of 10 mm"
        f"{others}, pushes of 0.95 J_cap.",
        "",
        *table_header("family", *names),
    ]
    for family, of in families.items():
        if any(entry["goals"] for entry in of.values()):
            mine = (of[name] for name in names)
            shares = (share_text(entry["goals_reached"], entry["goals"], entry["goal_cases"]) for entry in mine)
            lines.append(table_line(family, *shares))
    return lines


def _best(names: Sequence[str], families: Mapping[str, Mapping[str, Family]]) -> list[str]:
    """In how many cases a controller's median is at least as high as that of every other."""
    lines = [
        "## Cases in which nobody does better [95 % interval of the share]",
        "",
        "Compared by the median over seeds.",
        "",
        *table_header("family", *names),
    ]
    for family, of in families.items():
        cells = []
        for name in names:
            known = [(case, value["median"]) for case, value in of[name]["cases"].items()]
            best = sum(
                _value(median) >= max(_value(of[n]["cases"][case]["median"]) for n in names) - 1e-9
                for case, median in known
            )
            cells.append(share_text(best, len(known), len(known)))
        lines.append(table_line(family, *cells))
    return [*lines, ""]


def _spread(names: Sequence[str], families: Mapping[str, Mapping[str, Family]], seeds: Sequence[int]) -> list[str]:
    """How far seeds agree; nothing to say of a single one."""
    if len(seeds) < 2:
        return []
    lines = [
        "## Seeds: cases whose threshold is not the same for all (greatest difference)",
        "",
        *table_header("family", "unit", *names),
    ]
    for family, of in families.items():
        unit = next(iter(of.values()))["unit"]
        lines.append(table_line(family, unit_text(unit), *(_spread_text(of[name], unit) for name in names)))
    return [*lines, ""]


def _spread_text(entry: Family, unit: str) -> str:
    ranges = [case["high"] - case["low"] for case in entry["cases"].values() if case["low"] is not None]
    differ = sum(width > 1e-9 for width in ranges)
    return f"{differ}/{len(ranges)}" + (f" ({number_text(max(ranges), unit)})" if differ else "")


def _cases(names: Sequence[str], families: Mapping[str, Mapping[str, Family]]) -> list[str]:
    lines = [
        "## Every case: median over seeds (least to greatest)",
        "",
        *table_header("family", "case", "unit", *names),
    ]
    for family, of in families.items():
        unit = next(iter(of.values()))["unit"]
        for case in of[names[0]]["cases"]:
            found = [of[name]["cases"][case] for name in names]
            cells = [
                range_text(value["median"], value["low"], value["high"], unit, value.get("lowest")) for value in found
            ]
            lines.append(table_line(family, case, unit_text(unit), *cells))
    return lines


def _value(median: float | None) -> float:
    return -1.0 if median is None else median
