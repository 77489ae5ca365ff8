"""One bench: which cells there are, which are left, and what made the table."""

import dataclasses
import math
import os
import platform
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.estimation.registry import TRUTH
from surefoot.experiments.bench import criteria
from surefoot.experiments.bench.beliefs import beliefs
from surefoot.experiments.bench.cell_runner import run_cell
from surefoot.experiments.bench.cells import Case, Cell
from surefoot.experiments.bench.engine import Finished, Task, run_on_cluster, run_on_processes
from surefoot.experiments.bench.entries import OF_SCENARIO, BenchEntry, bench_entries
from surefoot.experiments.bench.families import cases
from surefoot.experiments.bench.fingerprint import code_fingerprint, entry_fingerprint, estimator_plug_in, plug_in
from surefoot.experiments.bench.imperfections import KIND, knows_all, with_seeds
from surefoot.experiments.bench.ladders import BIP
from surefoot.experiments.bench.ranking import as_data, standings
from surefoot.experiments.bench.shares import endings, shares
from surefoot.experiments.bench.store import BenchStore
from surefoot.experiments.bench.variations import PLANT, ledge_for, sizes_for, varied, varied_plant
from surefoot.experiments.bench.walk_families import WALK_FAMILIES
from surefoot.experiments.bench.walk_goals import goals_as_data, in_order
from surefoot.experiments.bench.walk_pushes import walk_pushes
from surefoot.experiments.bench.warm_up import warmed_up
from surefoot.experiments.runs.provenance import git_commit, versions
from surefoot.experiments.scenario.robots import check_robot, robot_named
from surefoot.experiments.scenario.scenario import parse_change

_CHANGEABLE = ("controller.", *OF_SCENARIO)


@dataclass(frozen=True, kw_only=True)
class BenchRequest:
    """What is asked for.

    Attributes:
        controllers: comma-separated, each a name with ``+key=value`` for settings; empty for all.
        families: names; none for all.
        quick: the coarse ladders and fewer cases.
        seeds, first_seed: how many seeds, from which on; seed 0 is each case as designed.
        vary_plant: mass, friction and delay vary with the seed too.
        every_level: run every level instead of bisecting.
        levels: these instead of each family's own, all of them run; none: its own.
        changes: ``controller.KEY=VALUE``, ``physics.KEY=VALUE``, or of sensors, estimator, motors and model_error, for
            all. Sensors and errors of the model that are set take each cell's own seed.
        goals: the figures that walks are to reach, instead of families; seed by seed. They are Bip's.
        robot: its name, or the path of its file from the working folder.
    """

    controllers: str = ""
    families: tuple[str, ...] = ()
    quick: bool = False
    seeds: int = 1
    first_seed: int = 0
    vary_plant: bool = False
    every_level: bool = False
    changes: tuple[str, ...] = ()
    levels: tuple[float, ...] = ()
    goals: bool = False
    robot: str = BIP


@dataclass(frozen=True, kw_only=True)
class Bench:
    """A request worked out.

    Attributes:
        request: what was asked for.
        entries: controllers that take part.
        cells: all of them, in the order of the table.
        about: what else the manifest says of it.
    """

    request: BenchRequest
    entries: tuple[BenchEntry, ...]
    cells: tuple[Cell, ...] = field(repr=False)
    about: Mapping[str, Any] = field(default_factory=dict)

    @property
    def walks(self) -> bool:
        """Whether some of it are walks."""
        return any(cell.case.family in WALK_FAMILIES for cell in self.cells)

    def manifest(self) -> dict[str, Any]:
        """What made the table; nothing of when, or how fast, or on how many workers."""
        of_scenario = {c.label: dict(c.scenario) for c in self.entries if c.scenario}
        return {
            "arguments": dataclasses.asdict(self.request),
            "seeds": _seeds(self.request),
            "cells": len(self.cells),
            "commit": git_commit(),
            "code": code_fingerprint(),
            "robot": _robot(self.request.robot),
            "versions": versions(),
            "plug_ins": _plug_ins(self.entries, self.request.robot),
            "settings": {c.label: dataclasses.asdict(c.settings) for c in self.entries},
            **({"scenario": of_scenario} if of_scenario else {}),
            "survived": criteria.survived_means(walks=self.walks, knows_all=all(map(_knows_all, self.cells))),
            "variation": {
                **sizes_for(self.request.robot),
                **({"ledge_m": ledge_for(self.request.robot)} if self.walks else {}),
                **({"plant": PLANT} if self.request.vary_plant else {}),
            },
            **({"goals": goals_as_data()} if self.request.goals else {}),
            **self.about,
            "machine": {"platform": platform.platform(), "processor": platform.machine(), "cores": os.cpu_count()},
        }


def plan_bench(request: BenchRequest) -> Bench:
    """Work out the cells. Raises InvalidInput."""
    if request.seeds < 1:
        raise InvalidInput("--seeds", request.seeds, "must be at least 1")
    if request.first_seed < 0:
        raise InvalidInput("--first-seed", request.first_seed, "must not be negative")
    if request.goals and (request.families or request.levels or request.quick):
        raise InvalidInput("--goals", True, "has cases and levels of its own: without --families, --levels, --quick")
    if request.goals and request.robot != BIP:
        raise InvalidInput("--goals", request.robot, "the goals are those of one robot", [BIP])
    changes = dict(parse_change(text) for text in request.changes)
    for path in changes:
        if not path.startswith(_CHANGEABLE):
            raise InvalidInput("--set", path, "a bench changes settings and the plant only", _CHANGEABLE)
    settings = {path.removeprefix("controller."): v for path, v in changes.items() if path.startswith("controller.")}
    of_scenario = {path: value for path, value in changes.items() if path.startswith(OF_SCENARIO)}
    entries = bench_entries(request.controllers, settings, of_scenario)
    code = code_of(entries, request.robot)
    cells = tuple(
        cell_of(
            varied(case if knows_all(entry.scenario) else warmed_up(case), seed),
            entry,
            seed,
            code[entry.label],
            changes=varied_plant(case, seed) if request.vary_plant else {},
            every_level=request.every_level or bool(request.levels),
        )
        for case, entry, seed in _in_order(request, entries)
    )
    for cell in {cell.label: cell for cell in reversed(cells)}.values():
        for level in request.levels or cell.case.levels[:1]:
            cell.scenario_at(level)  # a mistake in a change or a level shows before anything runs
    return Bench(request=request, entries=entries, cells=cells)


def code_of(entries: Sequence[BenchEntry], robot: str = BIP) -> dict[str, str]:
    """Label -> fingerprint of the code, and of the robot's files, that decide its outcomes."""
    return {c.label: entry_fingerprint(c.controller, str(c.scenario.get(KIND, TRUTH)), robot) for c in entries}


def cell_of(
    case: Case,
    entry: BenchEntry,
    seed: int,
    code: str,
    *,
    changes: Mapping[str, Any] | None = None,
    every_level: bool = False,
) -> Cell:
    """A case, already varied by its seed, under an entry; the seed is that of noise and errors of the model too.

    Args:
        case: which.
        entry: the controller, its settings, and what differs in the scenario.
        seed: of the cell.
        code: fingerprint of what decides the outcome.
        changes: further ones of the scenario, which those of the entry come after.
        every_level: run every level instead of bisecting.
    """
    return Cell(
        case=case,
        label=entry.label,
        controller=entry.controller,
        settings=dict(entry.changes),
        changes={**(changes or {}), **with_seeds(entry.scenario, seed)},
        seed=seed,
        every_level=every_level,
        code=code,
    )


def _knows_all(cell: Cell) -> bool:
    return knows_all(cell.changes)


def _robot(name: str) -> dict[str, str]:
    """For the manifest: what the file is called, and what is in it; where it lies is among the arguments."""
    return {"name": Path(name).name, "sha256": robot_named(name).sha256}


def _seeds(request: BenchRequest) -> list[int]:
    return list(range(request.first_seed, request.first_seed + request.seeds))


def _plug_ins(entries: Sequence[BenchEntry], robot: str) -> dict[str, Any]:
    """Of each controller and estimator from outside: package, versions and fingerprint."""
    found = {name: plug_in(name) for name in dict.fromkeys(c.controller for c in entries)}
    kinds = dict.fromkeys(str(c.scenario[KIND]) for c in entries if KIND in c.scenario)
    found |= {f"estimator {kind}": estimator_plug_in(kind) for kind in kinds}
    return {
        name: {
            "package": brought.package,
            "version": brought.version,
            "requires": brought.requires,
            "code": brought.fingerprint_with(robot),
        }
        for name, brought in found.items()
        if brought is not None
    }


def _cases(request: BenchRequest) -> list[Case]:
    """Those of the families, with the levels that are asked for. Raises InvalidInput."""
    robot = check_robot(request.robot, files=True, folder=Path())
    found = cases(request.families, quick=request.quick, robot=robot)
    levels = request.levels
    if not levels:
        return found
    if list(levels) != sorted(set(levels)) or levels[0] <= 0.0 or not all(map(math.isfinite, levels)):
        raise InvalidInput("--levels", list(levels), "must be positive and grow", ["0.01,0.02"])
    units = {case.unit: case.family for case in found}
    if len(units) > 1:
        valid = [f"--families {family}: {unit}" for unit, family in units.items()]
        raise InvalidInput("--levels", list(levels), "the families' levels have several units", valid)
    return [dataclasses.replace(case, levels=levels) for case in found]


def _in_order(request: BenchRequest, entries: Sequence[BenchEntry]) -> list[tuple[Case, BenchEntry, int]]:
    """What the cells are made from."""
    if request.goals:
        asked = {c.label: c for c in entries}
        played = in_order(_seeds(request), {c.label: c.controller for c in entries})
        return [(case, asked[label], seed) for case, label, seed in played]
    return [(case, c, seed) for case in _cases(request) for c in entries for seed in _seeds(request)]


def run_bench(
    bench: Bench,
    folder: Path,
    *,
    workers: int = 2,
    cluster: str = "",
    task: Task = run_cell,
    on_cell: Callable[[int, int], None] | None = None,
) -> Path:
    """Work through the cells that are not finished yet, then write the table.

    Args:
        bench: what to do.
        folder: of the store.
        workers: processes, or workers of a local cluster.
        cluster: address of a Dask scheduler, ``local``, or empty for processes of this machine.
        task: what to do with a cell.
        on_cell: called with (finished, all) at the start and after every cell.

    Raises:
        InvalidInput: the folder or the cluster cannot be used.
        WorkersLostError: workers keep dying.
    """
    if workers < 1:
        raise InvalidInput("--workers", workers, "must be at least 1")
    store = BenchStore(folder)
    store.write_manifest({**bench.manifest(), "complete": False})
    left = store.missing(bench.cells)
    done, total = len(bench.cells) - len(left), len(bench.cells)
    if on_cell:
        on_cell(done, total)
    engine: Finished = iter(())
    if left:
        engine = run_on_cluster(left, cluster, workers, task) if cluster else run_on_processes(left, workers, task)
    for cell, rows in engine:
        store.add(cell, rows)
        done += 1
        if on_cell:
            on_cell(done, total)
    table = store.write_table(bench.cells, {"surefoot": "bench", "code": code_fingerprint()})
    rows = store.rows(bench.cells)
    more = {
        "shares": shares(rows),
        "walk_pushes": walk_pushes(rows),
        "endings": endings(rows),
        "beliefs": beliefs(rows),
    }
    plain = {name: [dataclasses.asdict(entry) for entry in found] for name, found in more.items() if found}
    store.write_ranking({**as_data(standings(rows)), **plain})
    store.write_manifest({**bench.manifest(), "complete": True})
    return table
