"""What the help says that benches, maps and price lists cost, against what they plan."""

import math
import re
import shlex

import pytest
import tyro

from surefoot.cli.bench import Bench
from surefoot.cli.map import Map
from surefoot.cli.price import Price
from surefoot.experiments.bench.bench import plan_bench
from surefoot.experiments.maps.data import plan_maps
from surefoot.experiments.price.plan import PriceRequest, plan_price
from surefoot.resources import resource_folder

PAGE = (resource_folder("static") / "help" / "command_line.md").read_text(encoding="utf-8")
LINE = r"^\| `surefoot ((?:bench|map|price).*?)` \| (\d+) \| (\d+) \| (\d+) min \| (.+) min \|$"
LINES = re.findall(LINE, PAGE, re.MULTILINE)
PER_SECOND = 0.4, 0.8  # of one core, measured


def planned(command: str):
    """Cells of a command line."""
    name, *arguments = shlex.split(command)
    if name == "bench":
        return plan_bench(tyro.cli(Bench, args=arguments)._request()).cells
    if name == "map":
        asked = tyro.cli(Map, args=arguments)
        return plan_maps(asked.controllers, quick=asked.quick).cells
    asked = tyro.cli(Price, args=arguments)
    return plan_price(PriceRequest(quick=asked.quick, seeds=asked.seeds)).cells


@pytest.mark.parametrize(("command", "cells", "episodes", "minutes", "core"), LINES)
def test_the_page_says_what_is_planned(command, cells, episodes, minutes, core):
    found = planned(command)
    plays = [math.ceil(math.log2(len(cell.case.levels) + 1)) for cell in found]
    simulated_s = sum(n * cell.case.table["duration_s"] for n, cell in zip(plays, found, strict=True))
    assert (int(cells), int(episodes)) == (len(found), sum(plays))
    assert float(minutes) == pytest.approx(simulated_s / 60.0, abs=0.5)
    least, most = map(float, core.split(" to "))
    assert (least, most) == pytest.approx([share * simulated_s / 60.0 for share in PER_SECOND], abs=0.55)


def test_the_page_has_all_three_commands():
    assert {line[0].split()[0] for line in LINES} == {"bench", "map", "price"}


@pytest.mark.parametrize("command", [Bench, Map, Price])
def test_the_help_of_the_command_says_it_too(command):
    cells = {line[1] for line in LINES if line[0].split()[0] == command.__name__.lower() and "goals" not in line[0]}
    assert cells <= set(re.findall(r"\d+", command.__doc__))
    assert re.search(r"minutes|hours", command.__doc__) and "of one core" in command.__doc__
