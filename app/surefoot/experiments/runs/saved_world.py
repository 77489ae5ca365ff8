"""The world of a saved run at any of its rows: ground, stones, pushes and pulls, as the plant had them.

Ground and forces are read from the table, which the plant's own values were written into tick by tick. A stone moves by
``stone_pose``, as in the plant, from when it was placed until it was removed; both are in the manifest. Runs saved
before the table had these columns have the ground from the manifest, and no forces.
"""

from typing import Any

import numpy as np

from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.robot.description import RobotDescription
from surefoot.simulation.external_forces import NO_FORCE, ActingForce
from surefoot.simulation.ground import Ground, GroundPose, Tilt
from surefoot.simulation.recorder import FORCE_COLUMNS, GROUND_COLUMNS
from surefoot.simulation.stones import PlacedStone, Stone
from surefoot.simulation.terrain import Block, Terrain

_METRES_PER_NEWTON = 0.003  # length of a force's arrow on Bip, in every picture: a push of 200 N is 0.6 m long
SEEN_S = 0.05  # a force that has ended is shown this long: the shortest pushes lie between two pictures


def force_scale(robot: RobotDescription) -> float:
    """Length of a force's arrow [m/N]: against the robot as long as that of the same share of weight is on Bip."""
    return _METRES_PER_NEWTON * robot.sizes.com_height / robot.sizes.weight


class SavedWorld:
    """What was around the robot.

    Args:
        run: what was kept.

    Attributes:
        ground: where ``at_row`` has put it.
        terrain: what stands on it.

    Raises:
        InvalidInput: the manifest makes no sense.
    """

    def __init__(self, run: SavedRun) -> None:
        try:
            self._stones = tuple(_placed(entry) for entry in run.manifest["stones"])
            ground = run.manifest["ground"]
            self.ground = GroundPose(Ground(**ground["ground"]), np.array(ground["pivot_m"], dtype=float))
            self.ground.tilts = tuple(_tilt(entry) for entry in ground["tilts"])
            self.terrain = _terrain(run.manifest.get("terrain", {}))
        except (KeyError, TypeError, ValueError, SurefootError) as error:
            raise InvalidInput("manifest", str(error), "is not that of a saved run") from None
        self.time_s = run.column("time_s")
        self._slopes, self._forces = _columns(run, GROUND_COLUMNS), _columns(run, FORCE_COLUMNS)
        self._sizes = None if self._forces is None else np.linalg.norm(self._forces[:, :3], axis=1)

    def at_row(self, row: int) -> GroundPose:
        """Bring the ground to where it was."""
        if self._slopes is None:
            self.ground.move(float(self.time_s[row]))
        else:
            self.ground.lie_at(self._slopes[row])
        return self.ground

    def stones(self, row: int) -> tuple[PlacedStone, ...]:
        """The stones that there were, those still below the ground left out; in the order of their numbers."""
        now = float(self.time_s[row])
        there = [p for p in self._stones if p.placed_s <= now < p.removed_s and p.stone.top_at(now) > 0.0]
        return tuple(sorted(there, key=lambda placed: placed.number))

    def force(self, row: int) -> ActingForce:
        """The largest force from outside within the last ``SEEN_S``; ``NO_FORCE`` where there was none."""
        if self._forces is None or self._sizes is None:
            return NO_FORCE
        first = int(np.searchsorted(self.time_s, self.time_s[row] - SEEN_S, side="right"))
        strongest = first + int(np.argmax(self._sizes[first : row + 1]))
        if not self._sizes[strongest] > 0.0:
            return NO_FORCE
        return ActingForce(self._forces[strongest, :3], self._forces[strongest, 3:])


def _columns(run: SavedRun, names: tuple[str, ...]) -> np.ndarray | None:
    """Columns side by side (ticks, n); None where the run has been saved before there were any."""
    return np.column_stack([run.column(name) for name in names]) if set(names) <= set(run.columns) else None


def _placed(entry: dict[str, Any]) -> PlacedStone:
    removed = entry["removed_s"]
    return PlacedStone(
        number=int(entry["number"]),
        slot=int(entry["slot"]),
        stone=Stone(**entry["stone"]),
        placed_s=float(entry["placed_s"]),
        removed_s=np.inf if removed is None else float(removed),
    )


def _terrain(entry: Any) -> Terrain:
    if not isinstance(entry, dict):
        raise ValueError("terrain is no table")
    blocks = (Block(*(float(number) for number in block)) for block in entry.get("blocks", ()))
    return Terrain(tuple(blocks), float(entry.get("depth_m", 0.0)))


def _tilt(entry: dict[str, Any]) -> Tilt:
    before, after = entry["before"], entry["after"]
    return Tilt(
        float(entry["start_s"]),
        float(entry["duration_s"]),
        (float(before[0]), float(before[1])),
        (float(after[0]), float(after[1])),
    )
