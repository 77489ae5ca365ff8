from collections.abc import Callable

import pytest

from surefoot.robot_import.inspection import Inspection, inspect_robot


@pytest.fixture
def inspect(tmp_path) -> Callable[..., Inspection]:
    """MJCF text, and robot.toml text without its first line -> what is found."""

    def run(mjcf: str, toml: str | None = None) -> Inspection:
        (tmp_path / "robot.xml").write_text(mjcf)
        if toml is None:
            return inspect_robot(tmp_path / "robot.xml")
        (tmp_path / "robot.toml").write_text(f'mjcf = "robot.xml"\n{toml}')
        return inspect_robot(tmp_path / "robot.toml")

    return run
