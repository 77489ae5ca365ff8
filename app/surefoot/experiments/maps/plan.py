"""The runs that maps need when no bench table is given: the bench's own cells, fewer of them."""

from dataclasses import replace

from surefoot.experiments.bench.bench import Bench, BenchRequest
from surefoot.experiments.bench.cells import Cell
from surefoot.experiments.bench.entries import bench_entries
from surefoot.experiments.bench.families import cases
from surefoot.experiments.bench.fingerprint import controller_fingerprint
from surefoot.experiments.bench.levels import LADDERS

MAPPED = ("stone", "push", "push-double", "swing")
QUICK_CONTROLLERS = "two-part,soft-qp"
_QUICK_FAMILIES = ("stone", "push", "swing")
_QUICK_SWINGS = tuple(f"{word} {duration} s" for word in ("inward", "forward") for duration in ("0.3", "0.5", "1.0"))


def plan_maps(controllers: str = "", *, quick: bool = False) -> Bench:
    """Every place, direction and duration under each controller, on the bench's coarse ladders.

    Quick: two controllers unless told, single support, and swings inward and forward at three durations.

    Args:
        controllers: comma-separated, as ``surefoot bench`` takes them; empty for all registered ones.
        quick: fewer cells.

    Raises:
        InvalidInput: unknown controller or setting.
    """
    entries = bench_entries(controllers or (QUICK_CONTROLLERS if quick else ""), {})
    families = _QUICK_FAMILIES if quick else MAPPED
    wanted = [replace(case, levels=LADDERS[case.family][0]) for case in cases(families)]
    if quick:
        wanted = [case for case in wanted if case.family != "swing" or case.name in _QUICK_SWINGS]
    cells = [
        Cell(
            case=case, label=one.label, controller=one.controller, settings=dict(one.changes),
            code=controller_fingerprint(one.controller),
        )
        for case in wanted for one in entries
    ]  # fmt: skip
    request = BenchRequest(controllers=controllers, families=families, quick=True)
    return Bench(request=request, entries=entries, cells=tuple(cells))
