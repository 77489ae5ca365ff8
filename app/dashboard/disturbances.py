"""What a person does to Bip: stones that rise or drop, pushes, friction. Each returns its line for the log."""

from dataclasses import replace

import numpy as np

from app.dashboard import commands as ask
from app.dashboard.footprint import SOLE_PLACES, overlap, sole_place, stone_footprint
from app.errors import InvalidInput
from app.geometry.polygon import convex_hull
from app.simulation.loop import Simulation
from app.simulation.measurement import sole_outline
from app.simulation.pushes import WHOLE_ROBOT, Push
from app.simulation.stones import Stone

RISE_S = 0.3


def place_stone(simulation: Simulation, command: ask.PlaceStone) -> str:
    """A stone that rises where a sole is above it (one that appeared inside a foot would throw it off) or drops.

    Raises:
        InvalidInput: place, height or size out of range.
    """
    stone = Stone(
        x_m=command.x_m, y_m=command.y_m, height_m=command.height_m, size_m=(command.size_m, command.size_m),
        rise_start_s=simulation.time_s, rise_duration_s=RISE_S,
    )  # fmt: skip
    above = _sole_above(simulation, stone)
    simulation.plant.stones.place(stone if above else replace(stone, drops=True))
    return (
        f"stone {stone.height_m * 1e3:.0f} mm high, {command.size_m * 1e3:.0f} mm wide at x {stone.x_m:.3f}, "
        f"y {stone.y_m:.3f} m " + (f"rises under the {above} sole" if above else "drops")
    )


def place_stone_at_sole(simulation: Simulation, command: ask.PlaceStoneAtSole) -> str:
    """A stone under a place of the sole that stands. Raises InvalidInput."""
    if command.place not in SOLE_PLACES:
        raise InvalidInput("stone.place", command.place, "no such place", SOLE_PLACES)
    index = simulation.support.reference_foot
    foot, truth = simulation.robot.feet[index], simulation.plant.feet()[index]
    local = np.array((*sole_place(foot, command.place), -foot.ankle_height_m))
    x, y, _ = truth.position_ankle + truth.rotation.dot(local)
    at = ask.PlaceStone(x_m=float(x), y_m=float(y), height_m=command.height_m, size_m=command.size_m)
    return place_stone(simulation, at)


def push_now(simulation: Simulation, command: ask.PushNow) -> str:
    """A push that starts with the next tick. Raises InvalidInput."""
    links = (WHOLE_ROBOT, *simulation.robot.links)
    if command.link not in links:
        raise InvalidInput("push.link", command.link, "no such link", links)
    now = simulation.time_s
    push = Push(
        link=command.link, direction_deg=command.direction_deg, impulse_ns=command.impulse_ns, start_s=now,
        duration_s=command.duration_s,
    )  # fmt: skip
    simulation.pushes[:] = [*(p for p in simulation.pushes if p.start_s + p.duration_s > now), push]
    return f"push {push.impulse_ns:g} N s towards {push.direction_deg:.0f} deg in {push.duration_s:g} s"


def set_friction(simulation: Simulation, friction: float) -> str:
    """Friction of ground and stones from now on. Raises InvalidInput."""
    simulation.plant.change_physics(replace(simulation.plant.physics, friction=friction))
    return f"friction {friction:g}"


def _sole_above(simulation: Simulation, stone: Stone) -> str | None:
    footprint = stone_footprint(stone.x_m, stone.y_m, stone.size_m)
    for i, truth in enumerate(simulation.plant.feet()):
        outline = sole_outline(simulation.robot, truth, i)
        if np.isfinite(outline).all() and overlap(convex_hull(outline.tolist()), footprint):
            return str(simulation.robot.feet[i].side)
    return None
