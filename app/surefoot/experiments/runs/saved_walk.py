"""The footsteps of a walk in a run's manifest: where they were planned, and when they landed and where."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.gait.footsteps import Footstep
from surefoot.gait.walk import STEPS_AHEAD, Walk

FOOTSTEPS = "footsteps"


def footsteps_entry(walk: Walk) -> list[dict[str, Any]]:
    """All steps as plain values; ``landed_s`` and ``led_to_m`` are None of those that have not landed."""
    nothing = [None] * len(walk.footsteps)
    landed = zip((*walk.landed_s, *nothing), (*[point.tolist() for point in walk.led_to], *nothing), strict=True)
    return [
        {
            "foot": step.foot,
            "x_m": float(step.point[0]),
            "y_m": float(step.point[1]),
            "yaw_rad": float(step.yaw_rad),
            "landed_s": landed_s,
            "led_to_m": led_to,
        }
        for step, (landed_s, led_to) in zip(walk.footsteps, landed, strict=False)
    ]


class SavedWalk:
    """The footsteps of a saved run; none where it did not walk, or was saved before they were kept.

    Args:
        manifest: of the run.

    Raises:
        InvalidInput: they make no sense.
    """

    def __init__(self, manifest: Mapping[str, Any]) -> None:
        try:
            entries = [_step(entry) for entry in manifest.get(FOOTSTEPS, ())]
        except (KeyError, TypeError, ValueError) as error:
            raise InvalidInput(f"manifest: {FOOTSTEPS}", str(error), "is not that of a saved run") from None
        self._steps = [step for step, _ in entries]
        self._landed_s = [landed_s for _, landed_s in entries]
        self._fell_s = min((float(time_s) for time_s, kind, _ in manifest["events"] if kind == "fall"), default=np.inf)

    def steps_ahead(self, time_s: float) -> tuple[Footstep, ...]:
        """The next steps at a time [s], where they were led; none of a robot that has fallen.

        A step that was moved while its foot was in the air is told where it was to be set down when it landed, also
        before; one that has not landed, and those of older files, where they were planned. Of a walk that was steered
        they are those that it came to, also before it was told.
        """
        if time_s >= self._fell_s:
            return ()
        made = sum(landed_s <= time_s for landed_s in self._landed_s)
        return tuple(self._steps[made : made + STEPS_AHEAD])


def _step(entry: Any) -> tuple[Footstep, float]:
    """One step, and when it landed [s]: infinite for never."""
    foot, landed_s = entry["foot"], entry["landed_s"]
    if foot not in (0, 1):
        raise ValueError(f"there is no foot {foot!r}")
    x, y = entry.get("led_to_m") or (entry["x_m"], entry["y_m"])  # older files say only where it was planned
    step = Footstep(foot, np.array((float(x), float(y))), float(entry["yaw_rad"]))
    return step, np.inf if landed_s is None else float(landed_s)
