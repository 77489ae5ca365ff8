"""How wrong the estimators were, as a table in a bench's page."""

from collections.abc import Mapping, Sequence
from typing import Any

from surefoot.experiments.bench.episode import LEARNS_S
from surefoot.experiments.bench.words import number_text, spread_text, table_header, table_line, unit_text

TITLE = "What was believed: median over seeds (least to greatest)"
HOW = (
    "Of the episodes survived. DCM and tilt: 99th percentile over an episode of the error of the belief, without its "
    f"first {LEARNS_S:g} s, in which an estimator finds the biases of its sensors. CoM: how far the true one was from "
    "its reference while the robot stood before the disturbance, or at the end where there is none."
)
COLUMNS = ("family", "case", "controller", "level", "survived", "DCM [mm]", "tilt [deg]", "CoM [mm]")


def beliefs_told(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """Title, explanation and table; nothing where nobody believes anything."""
    return [f"## {TITLE}", "", HOW, "", *belief_lines(found), ""] if found else []


def belief_lines(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """The table alone."""
    return [*table_header(*COLUMNS), *(table_line(*_cells(entry)) for entry in found)]


def _cells(entry: Mapping[str, Any]) -> tuple[str, ...]:
    level = f"{number_text(entry['level'], entry['unit'])} {unit_text(entry['unit'])}"
    errors = _range(entry["dcm_mm"], 1), _range(entry["tilt_deg"], 3), _range(entry["com_mm"], 1)
    return entry["family"], entry["case"], entry["controller"], level, f"{entry['survived']}/{entry['seeds']}", *errors


def _range(of: Mapping[str, float], digits: int) -> str:
    return spread_text(*(f"{of[name]:.{digits}f}" for name in ("median", "low", "high")))
