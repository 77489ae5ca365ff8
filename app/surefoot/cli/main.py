"""The command line: every flag has a help text; a mistake is one clear line and exit code 2."""

import os

from surefoot.blas_threads import ONE_THREAD

os.environ.update(ONE_THREAD | os.environ)  # before NumPy is imported; who has set them keeps what was set

import sys
from typing import Annotated

import tyro

from surefoot.cli.ablate import Ablate
from surefoot.cli.bench import Bench
from surefoot.cli.dashboard import Dashboard
from surefoot.cli.equations import Equations
from surefoot.cli.figures import Figures
from surefoot.cli.grid import Grid
from surefoot.cli.map import Map
from surefoot.cli.plan import Plan
from surefoot.cli.price import Price
from surefoot.cli.replay import Replay
from surefoot.cli.rerun import Rerun
from surefoot.cli.robot import Robot
from surefoot.cli.run import Run
from surefoot.cli.settings import Settings
from surefoot.errors import SurefootError

Command = (
    Annotated[Dashboard, tyro.conf.subcommand("dashboard")]
    | Annotated[Run, tyro.conf.subcommand("run")]
    | Annotated[Replay, tyro.conf.subcommand("replay")]
    | Annotated[Rerun, tyro.conf.subcommand("rerun")]
    | Annotated[Plan, tyro.conf.subcommand("plan")]
    | Annotated[Grid, tyro.conf.subcommand("grid")]
    | Annotated[Figures, tyro.conf.subcommand("figures")]
    | Annotated[Ablate, tyro.conf.subcommand("ablate")]
    | Annotated[Bench, tyro.conf.subcommand("bench")]
    | Annotated[Price, tyro.conf.subcommand("price")]
    | Annotated[Map, tyro.conf.subcommand("map")]
    | Annotated[Robot, tyro.conf.subcommand("robot")]
    | Annotated[Settings, tyro.conf.subcommand("settings")]
    | Annotated[Equations, tyro.conf.subcommand("equations")]
)


def main(arguments: list[str] | None = None) -> None:
    """Parse, run, and turn the errors a person can cause into one line and exit code 2."""
    command = tyro.cli(Command, prog="surefoot", description=__doc__, args=arguments)  # type: ignore[call-overload]
    try:
        command.main()
    except SurefootError as error:
        print(f"surefoot: {error}", file=sys.stderr)
        raise SystemExit(2) from None
    except ImportError as error:
        if error.name is None or error.name.split(".")[0] == "surefoot":
            raise
        found = f" (found at {error.path})" if error.path else ""
        print(f"surefoot: a library cannot be used: {error}{found}; see PYTHONPATH", file=sys.stderr)
        raise SystemExit(2) from None
    except KeyboardInterrupt:
        raise SystemExit(130) from None
    except BrokenPipeError:
        sys.stderr.close()
        raise SystemExit(141) from None
