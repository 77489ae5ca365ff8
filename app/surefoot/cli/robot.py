"""``surefoot robot``: whether a robot of your own can be run here, and a robot.toml to start from."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro


@dataclass(frozen=True)
class RobotCheck:
    """Report what is found in a robot's MJCF or URDF, and how; exit code 1, reason and remedy where it cannot run."""

    file: tyro.conf.Positional[Path]
    """An MJCF, a URDF, or a robot.toml that names one."""
    json: bool = False
    """Print the whole report as JSON."""

    def main(self) -> None:
        """Check it. Raises InvalidInput, SystemExit(1)."""
        from surefoot.cli.console import wide_console
        from surefoot.cli.robot_tables import print_report
        from surefoot.robot_import.inspection import inspect_robot
        from surefoot.robot_import.report import report

        table = report(inspect_robot(self.file))
        if self.json:
            print(json.dumps(table, indent=2))
        else:
            print_report(table, wide_console())
        if not table["fit"]:
            raise SystemExit(1)


@dataclass(frozen=True)
class RobotInit:
    """Write a robot.toml to start from: what is found in an MJCF or a URDF, and what could be said besides."""

    file: tyro.conf.Positional[Path]
    """The MJCF or URDF."""
    out: Path = Path("robot.toml")
    """The file to write; one that is there is not overwritten."""

    def main(self) -> None:
        """Write it. Raises InvalidInput."""
        from surefoot.errors import InvalidInput
        from surefoot.output_files import OUT, check_kind, check_writable, write_file, writing
        from surefoot.robot_import.inspection import inspect_robot
        from surefoot.robot_import.robot_file_text import robot_file_text

        check_kind(self.out, [".toml"])
        if self.out.exists():
            raise InvalidInput(OUT, str(self.out), "is there already: name another file, or take it away first")
        check_writable(self.out)
        text = robot_file_text(inspect_robot(self.file), self.out)
        with writing(self.out):
            write_file(self.out, text)
        print(f"{self.out} written; check it with: surefoot robot check {self.out}")


@dataclass(frozen=True)
class Robot:
    """Bring a robot of your own: check its MJCF or URDF, or write a robot.toml to start from."""

    task: tyro.conf.OmitSubcommandPrefixes[
        Annotated[RobotCheck, tyro.conf.subcommand("check")] | Annotated[RobotInit, tyro.conf.subcommand("init")]
    ]

    def main(self) -> None:
        """Do it. Raises InvalidInput, SystemExit(1)."""
        self.task.main()
