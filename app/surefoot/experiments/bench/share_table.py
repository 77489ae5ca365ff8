"""Which walks and steps are survived and what ended the others, as tables: on the terminal and in a bench's page."""

from collections.abc import Mapping, Sequence
from typing import Any

from surefoot.experiments.bench.ankle_stop import BEFORE_S, LONG_ENOUGH_S
from surefoot.experiments.bench.words import number_text, table_header, table_line, unit_text

TITLE = "Walks completed and pushes caught, of all seeds [95 % interval of the share]"
ENDINGS_TITLE = "What ended the walks and steps that failed, by family"
ENDINGS_COLUMNS = ("family", "controller", "runs", "failed", "what ended them", "ankle at its stop before")
COLUMNS = ("family", "case", "controller", "level", "survived", "what ended the others")
SHARES = (
    "Levels that were played with every seed. Wilson's interval: where a seed draws the ground (stones, tiles, place "
    "of a ledge), noise or errors of the model, each is a trial of its own, elsewhere all seeds of a case are one."
)

ENDINGS = (
    "All levels and seeds that were played. Of a walk that fell, its first cause; of other falls, what the fall is "
    "called; `unsettled`: no fall, but not completed in its time. Ankle at its stop: one of a foot that carries, in "
    f"the last {BEFORE_S:g} s before the first cause, for {1e3 * LONG_ENOUGH_S:g} ms or more."
)


def walks_completed(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """Which share of the seeds is survived; nothing to say where nobody steps."""
    if not found:
        return []
    return [f"## {TITLE}", "", " ".join([SHARES, *steps_text(found)]), "", *share_lines(found), ""]


def share_lines(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """The table alone."""
    return [*table_header(*COLUMNS), *(table_line(*share_cells(entry)) for entry in found)]


def steps_text(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """What J_cap1 is, with reach and landing time of its step; nothing where no level is a share of it."""
    steps = dict.fromkeys(share["step"] for share in found if share["step"])
    return [f"J_cap1 is what one step can catch: up to {step}." for step in steps]


def share_cells(share: Mapping[str, Any]) -> tuple[str, ...]:
    """A line of the table of walks: family, case, controller, level, share, what ended the others."""
    low, high = share["interval"]
    level = f"{number_text(share['level'], share['unit'])} {unit_text(share['unit'])}"
    if share["bound_ns"] is not None:
        level += f" of {share['bound_ns']:.1f} N s"
    came = f"{share['completed']}/{share['seeds']} [{low:.2f}, {high:.2f}]"
    return share["family"], share["case"], share["controller"], level, came, ended_text(share)


def ended_text(found: Mapping[str, Any]) -> str:
    """What ended those that failed, each with how many; a dash where none did."""
    stopped = found.get("ankle_stop", 0)
    return _causes(found) + (f" (ankle at its stop before {stopped})" if stopped else "")


def walks_ended(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """What ended the runs that failed, by family and controller; nothing to say where nobody steps."""
    if not found:
        return []
    header, lines = table_header(*ENDINGS_COLUMNS), [table_line(*endings_cells(entry)) for entry in found]
    return [f"## {ENDINGS_TITLE}", "", ENDINGS, "", *header, *lines, ""]


def endings_cells(found: Mapping[str, Any]) -> tuple[str, ...]:
    """A line of the table of what ended them: family, controller, runs, failed, causes, ankle at its stop."""
    failed = sum(found["ended"].values())
    stopped = f"{found['ankle_stop']} of {failed}" if failed else "-"
    return found["family"], found["controller"], str(found["runs"]), str(failed), _causes(found), stopped


def _causes(found: Mapping[str, Any]) -> str:
    return ", ".join(f"{cause} {count}" for cause, count in found["ended"].items()) or "-"
