"""The robot of a saved run: whether its files are still those that the run was made with, and where they are now."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.runs.saved_run import ROBOT_SHA256, SavedRun
from surefoot.experiments.scenario.robots import check_robot, sha256_now


def robot_note(manifest: Mapping[str, Any]) -> str | None:
    """One line where a robot's files are not those that a run or a bench was made with; None where they are.

    None too for what was made before manifests had the SHA-256 of these files.
    """
    then, robot = manifest.get(ROBOT_SHA256), str(manifest.get("robot", ""))
    if then is None:
        return None
    try:
        now = sha256_now(robot)
    except InvalidInput as error:
        return f"its robot cannot be looked at: {error}"
    if now == then:
        return None
    return f"the files of its robot {robot} have changed since: SHA-256 was {then[:16]}, is {now[:16]}"


def with_robot(run: SavedRun, robot: str | None) -> SavedRun:
    """The run with its robot's file where ``robot`` says that it lies now (from the working folder); None: as it is.

    Raises:
        InvalidInput: no such robot.
    """
    if robot is None:
        return run
    name = check_robot(robot, files=True, folder=Path())
    scenario = {**run.manifest["scenario"], "robot": name}
    return replace(run, manifest={**run.manifest, "robot": name, "scenario": scenario})
