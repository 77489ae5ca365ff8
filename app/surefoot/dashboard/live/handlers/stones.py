"""Stones that are placed, moved and taken away. Each returns its line for the log."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.observation.event_log import LogLine
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.messages.stone_view import SOLE_PLACES, overlap, sole_place, stone_footprint
from surefoot.errors import InvalidInput
from surefoot.geometry.polygon import convex_hull
from surefoot.simulation.event_texts import stone_name, stone_text
from surefoot.simulation.loop import Simulation
from surefoot.simulation.measurement import sole_outline
from surefoot.simulation.stones import WEDGE, Stone

RISE_S = 0.3


def place_stone(live: LiveRun, command: cmd.PlaceStone) -> LogLine:
    """A stone that rises where a sole is above it (one that appeared inside a foot would throw it off) or drops.

    Raises:
        InvalidInput: place, height or size out of range.
    """
    simulation = live.simulation
    stone = Stone(
        x_m=command.x_m,
        y_m=command.y_m,
        height_m=command.height_m,
        size_m=(command.size_m, command.size_m),
        rise_start_s=simulation.time_s,
        rise_duration_s=RISE_S,
        **_shape(command),
    )
    above = _sole_above(simulation, stone)
    simulation.plant.stones.place(stone if above else replace(stone, drops=True))
    return _line(stone_text(stone, f"rises under the {above} sole" if above else "drops"))


def place_stone_at_sole(live: LiveRun, command: cmd.PlaceStoneAtSole) -> LogLine:
    """A stone under a place of the sole that stands. Raises InvalidInput."""
    simulation = live.simulation
    if command.place not in SOLE_PLACES:
        raise InvalidInput("stone.place", command.place, "no such place", SOLE_PLACES)
    index = simulation.support.reference_foot
    foot, truth = simulation.robot.feet[index], simulation.plant.feet()[index]
    local = np.array((*sole_place(foot, command.place), -foot.ankle_height_m))
    x, y, _ = truth.position_ankle + truth.rotation.dot(local)
    at = cmd.PlaceStone(
        x_m=float(x),
        y_m=float(y),
        height_m=command.height_m,
        size_m=command.size_m,
        shape=command.shape,
        slope_deg=command.slope_deg,
        slope_direction_deg=command.slope_direction_deg,
    )
    return place_stone(live, at)


def move_stone(live: LiveRun, command: cmd.MoveStone) -> LogLine:
    """Shift a stone. Raises InvalidInput: no such stone, place out of range.

    Where a sole is above its new place it rises again, as a new one does: pushed in at full height it would throw the
    robot off. Elsewhere it lies there at once.
    """
    simulation = live.simulation
    pool, now = simulation.plant.stones, simulation.time_s
    before = pool.find(command.number).stone
    here = replace(
        before, x_m=command.x_m, y_m=command.y_m, rise_start_s=now, rise_duration_s=RISE_S, drops=False, lying=False
    )
    if _sole_above(simulation, here) is None:
        here = replace(here, rise_start_s=Stone.rise_start_s, rise_duration_s=Stone.rise_duration_s, lying=True)
    pool.move_to(command.number, here)
    text = f"{stone_name(here)} {command.number + 1} moved to x {here.x_m:.3f}, y {here.y_m:.3f} m"
    return _line(text, f"move {command.number}")


def remove_stone(live: LiveRun, command: cmd.RemoveStone) -> LogLine:
    """Take one away. Raises InvalidInput."""
    removed = live.simulation.plant.stones.remove(command.number)
    return _line(f"{stone_name(removed)} {command.number + 1} removed")


def remove_last_stone(live: LiveRun, command: cmd.RemoveLastStone) -> LogLine:
    """Take the newest one away."""
    return _line("newest stone removed" if live.simulation.plant.stones.remove_last() else "there is no stone")


def clear_stones(live: LiveRun, command: cmd.ClearStones) -> LogLine:
    """Take all away."""
    live.simulation.plant.stones.clear()
    return _line("all stones removed")


def _line(text: str, topic: str = "") -> LogLine:
    return LogLine(EventKind.STONE, text, topic)


def _shape(command: cmd.StoneKind) -> dict[str, Any]:
    """A slope belongs to a wedge only."""
    slope = {"slope_deg": command.slope_deg, "slope_direction_deg": command.slope_direction_deg}
    return {"shape": command.shape, **(slope if command.shape == WEDGE else {})}


def _sole_above(simulation: Simulation, stone: Stone) -> str | None:
    footprint = stone_footprint(stone.x_m, stone.y_m, stone.size_m)
    for i, truth in enumerate(simulation.plant.feet()):
        outline = sole_outline(simulation.plant.built, truth, i)
        if np.isfinite(outline).all() and overlap(convex_hull(outline.tolist()), footprint):
            return str(simulation.robot.feet[i].side)
    return None


HANDLERS: dict[type, Callable[[LiveRun, Any], LogLine | None]] = {
    cmd.PlaceStone: place_stone,
    cmd.PlaceStoneAtSole: place_stone_at_sole,
    cmd.MoveStone: move_stone,
    cmd.RemoveStone: remove_stone,
    cmd.RemoveLastStone: remove_last_stone,
    cmd.ClearStones: clear_stones,
}
