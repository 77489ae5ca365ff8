"""Seeds: small random changes of a case, the same for every controller.

Seed 0 is the case as it was designed.
"""

import copy
import zlib
from dataclasses import replace
from typing import Any

import numpy as np

from surefoot.experiments.bench.cells import Case
from surefoot.experiments.scenario.proportions import proportions_of, scaled

# Greatest change either way, drawn uniformly; lengths are Bip's, another robot's in proportion
SIZES = {
    "onset_s": 0.05,  # of pushes, rising stones, tilts and swings
    "place_m": 0.005,  # of stones, each axis
    "direction_deg": 2.0,  # of pushes and slopes
}
LEDGE_M = 0.1  # greatest change of a ledge's place: half a step, so that it meets any part of the foot
# With --vary-plant, what the controller does not know. The mass: under a stiffness of 60 1/s2 a plant 3 % heavier sags
# by 5 mm; from 6 % on every controller of this kind would miss the 10 mm criterion while standing still.
PLANT = {"mass_scale": (0.97, 1.03), "friction": (0.5, 1.0), "control_delay_s": (0.0, 0.001, 0.002)}


def sizes_for(robot: str) -> dict[str, float]:
    """``SIZES`` of a robot as a scenario names it."""
    return {**SIZES, "place_m": scaled(SIZES["place_m"], proportions_of(robot).sole_width)}


def ledge_for(robot: str) -> float:
    """``LEDGE_M`` of a robot as a scenario names it."""
    return scaled(LEDGE_M, proportions_of(robot).leg)


def varied(case: Case, seed: int) -> Case:
    """The case with onsets, places and directions as a seed has them; stones under steps and tiles are its own."""
    if seed == 0:
        return case
    random = _random(case, seed, "onset and place")
    table: dict[str, Any] = copy.deepcopy(dict(case.table))
    sizes = sizes_for(table["robot"])
    for stone in table.get("stones", ()):
        _shift(stone, "x_m", sizes["place_m"], random)
        _shift(stone, "y_m", sizes["place_m"], random)
        _shift(stone, "rise_start_s", sizes["onset_s"], random)
    for push in table.get("pushes", ()):
        _shift(push, "direction_deg", sizes["direction_deg"], random)
        _shift(push, "start_s", sizes["onset_s"], random)
    _shift(table.get("reference", {}), "start_s", sizes["onset_s"], random)
    _shift(table.get("ground", {}), "direction_deg", sizes["direction_deg"], random)
    _shift(table.get("ground", {}), "tilt_start_s", sizes["onset_s"], random)
    for ledge in table.get("ledges", ()):
        _shift(ledge, "x_m", ledge_for(table["robot"]), random)
    for drawn in (table.get("stones_under_steps", {}), table.get("ground", {}).get("tiles", {})):
        if "seed" in drawn:
            drawn["seed"] = seed
    return replace(case, table=table)


def varied_plant(case: Case, seed: int) -> dict[str, Any]:
    """Changes of the plant (dotted path -> value) as a seed has them; none for seed 0."""
    if seed == 0:
        return {}
    random = _random(case, seed, "plant")
    return {
        "physics.mass_scale": round(float(random.uniform(*PLANT["mass_scale"])), 4),
        "physics.friction": round(float(random.uniform(*PLANT["friction"])), 3),
        "physics.control_delay_s": float(random.choice(PLANT["control_delay_s"])),
    }


def _random(case: Case, seed: int, what: str) -> np.random.Generator:
    return np.random.default_rng([seed, zlib.crc32(f"{case.family}/{case.name}/{what}".encode())])


def _shift(table: dict[str, Any], key: str, size: float, random: np.random.Generator) -> None:
    if key in table:
        table[key] = round(table[key] + float(random.uniform(-size, size)), 4)
