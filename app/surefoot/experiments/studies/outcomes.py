"""How runs ended, as a table that can be printed and drawn."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Outcome:
    """One cell.

    Attributes:
        kind: ``stands``, ``falls`` or ``refused`` (the program would not run it).
        number: largest CoM error [mm] of a run that stands, time [s] of a fall; None for a refusal.
        note: what else is worth knowing, a few characters.
    """

    kind: str
    number: float | None
    note: str = ""

    @property
    def text(self) -> str:
        """``6 mm``, ``1.41 s`` or ``refused``."""
        if self.number is None:
            return self.kind
        return f"{self.number:.1f} mm" if self.kind == "stands" else f"{self.number:.2f} s"

    @property
    def words(self) -> str:
        """For a printed table."""
        note = f" {self.note}" if self.note else ""
        if self.number is None:
            return self.kind + note
        return f"{self.kind}, {self.text}{note}" if self.kind == "stands" else f"**{self.kind}** {self.text}{note}"


def outcome_of(summary: Mapping[str, Any]) -> Outcome:
    """How a run ended. A star notes a run that stands with ticks in which a QP had no solution."""
    if summary["fell"]:
        return Outcome("falls", summary["fall_time_s"])
    return Outcome("stands", 1e3 * summary["com_error_max_m"], "*" if summary["qp_infeasible_ticks"] else "")


@dataclass(frozen=True)
class OutcomeTable:
    """Rows by columns of outcomes.

    Attributes:
        title: what varies along the columns.
        rows, columns: names.
        cells: (row, column) -> outcome.
    """

    title: str
    rows: Sequence[str]
    columns: Sequence[str]
    cells: Mapping[tuple[str, str], Outcome]

    def standing(self, row: str) -> int:
        """In how many columns a row stands."""
        return sum(self.cells[row, column].kind == "stands" for column in self.columns)

    def markdown(self) -> str:
        """The table, one line a row, the number of columns in which it stands at the end."""
        lines = [f"| {self.title} | {' | '.join(self.columns)} | stands |", "|---" * (len(self.columns) + 2) + "|"]
        for row in self.rows:
            words = [self.cells[row, column].words for column in self.columns]
            lines.append(f"| {row} | {' | '.join(words)} | {self.standing(row)}/{len(self.columns)} |")
        return "\n".join(lines)
