"""Hostile input, made at random: each ends in one clear line or in a valid run, and no NaN reaches motors or page.

150 of each of nine kinds in the usual run, 1,500 of each with ``-m slow``; the same ones each time.
"""

import io
import json
import math

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as some

from surefoot.control.interface import ControlOutput, Status
from surefoot.control.output_check import output_fault
from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.command_check import check_command
from surefoot.dashboard.messages.run_link import link_target, read_link
from surefoot.dashboard.panels.tuning.presets import read_preset
from surefoot.errors import SurefootError
from surefoot.experiments.runs.partial_file import PARTIAL, PartialWriter
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import npz_bytes, parquet_bytes
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.experiments.scenario.reference_spec import FootstepSpec
from surefoot.experiments.scenario.scenario import (
    Scenario,
    load_scenario,
    parse_change,
    scenario_from_table,
    shipped_scenarios,
)
from surefoot.experiments.scenario.uneven_ground import Ledge

FEW, MANY = 150, 1500
LONGEST_LINE = 4000

numbers = some.one_of(
    some.floats(allow_nan=True, allow_infinity=True),
    some.integers(),
    some.sampled_from([0, -0.0, 1e308, -1e308, 5e-324, 10**400, True, False, 0.05, 1, 3]),
)
plain = some.one_of(numbers, some.text(max_size=20), some.none(), some.binary(max_size=5))
anything = some.recursive(
    plain, lambda inner: some.lists(inner, max_size=3) | some.dictionaries(some.text(max_size=8), inner, max_size=3)
)
TABLES = {
    name: list(getattr(Scenario(), name).__dataclass_fields__)
    for name in ("reference", "ground", "physics", "stones_under_steps")
}
LISTS = {"footsteps": list(FootstepSpec.__dataclass_fields__), "ledges": list(Ledge.__dataclass_fields__)}
STONE = ["x_m", "y_m", "height_m", "size_m", "shape", "slope_deg", "rise_start_s", "lying", "drops", "colour"]
PUSH = ["link", "direction_deg", "impulse_ns", "start_s", "duration_s"]
SETTINGS = list(ControllerSettings.__dataclass_fields__)


def hostile(strategy):
    """The test twice: with few examples, and, marked slow, with many; always the same ones."""

    def decorate(check):
        def made(count):
            options = settings(
                max_examples=count, deadline=None, derandomize=True, database=None,
                phases=(Phase.generate,), suppress_health_check=list(HealthCheck),
            )  # fmt: skip
            return options(given(strategy)(lambda example: check(example)))

        @pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])
        def test(count):
            made(count)()

        test.__doc__ = check.__doc__
        return test

    return decorate


def outcome(work):
    """What comes of it; None for a refusal, which must be one line that a person can read."""
    try:
        return work()
    except SurefootError as error:
        text = str(error)
        assert len(text.splitlines()) == 1, text
        assert 0 < len(text) <= LONGEST_LINE, len(text)
        return None


def keyed(names, values=anything, most=4):
    """A table with some of these keys, and perhaps a foreign one."""
    return some.dictionaries(some.sampled_from(names) | some.text(max_size=6), values, max_size=most)


scenarios = some.fixed_dictionaries(
    {},
    optional={
        "robot": some.just("bip") | anything, "support": some.sampled_from(["left", "right", "double"]) | anything,
        "duration_s": some.just(0.01) | anything, "com_height_m": anything, "drop_height_m": anything,
        **{name: keyed(fields) | anything for name, fields in TABLES.items()},
        **{name: some.lists(keyed(fields), max_size=3) | anything for name, fields in LISTS.items()},
        "stones": some.lists(keyed(STONE), max_size=3) | anything,
        "pushes": some.lists(keyed(PUSH), max_size=3) | anything,
        "controller": keyed(SETTINGS) | anything,
    },
).map(lambda table: {"robot": "bip", "support": "left", "duration_s": 0.01, **table})  # fmt: skip


@hostile(scenarios)
def test_a_scenario_is_refused_or_holds_numbers_only(table):
    """A parsed scenario file with anything in it."""
    scenario = outcome(lambda: scenario_from_table(table))
    if scenario is not None:
        assert all(math.isfinite(push.impulse_ns) for push in scenario.pushes)
        assert math.isfinite(scenario.physics.friction)


FILES = [path.read_bytes() for path in shipped_scenarios().values()]
damage = some.lists(some.tuples(some.integers(0, 400), some.integers(0, 255), some.booleans()), min_size=1, max_size=6)


def damaged(content: bytes, places) -> bytes:
    """Bytes changed or cut out."""
    changed = bytearray(content)
    for place, byte, cut in places:
        if changed:
            at = place % len(changed)
            changed[at : at + 1] = b"" if cut else bytes((byte,))
    return bytes(changed)


@pytest.fixture(autouse=True, scope="module")
def folder(tmp_path_factory):
    """Where the files lie that are read here."""
    hostile.folder = tmp_path_factory.mktemp("hostile")
    return hostile.folder


@hostile(some.tuples(some.sampled_from(FILES), damage) | some.binary(max_size=300))
def test_a_damaged_scenario_file_is_refused_or_read(given_bytes):
    """A shipped file with some bytes changed, or bytes of no kind."""
    content = given_bytes if isinstance(given_bytes, bytes) else damaged(*given_bytes)
    file = hostile.folder / "damaged.toml"
    file.write_bytes(content)
    outcome(lambda: load_scenario(file))


paths = some.lists(some.sampled_from(["controller", "stones", "pushes", "physics", "0", "7", "²", ""]), max_size=4)
values = (
    numbers.map(repr) | some.text(max_size=20) | some.sampled_from(["[" * 3000, "{}", "nan", "'", "1e999", "9" * 5000])
)


@hostile(some.tuples(paths, some.sampled_from([*SETTINGS, *STONE, "friction", "", "x"]), values, some.text(max_size=3)))
def test_a_change_is_refused_or_taken(change):
    """--set PATH=VALUE."""
    path, last, value, junk = change
    text = f"{'.'.join([*path, last])}{junk}={value}"
    outcome(lambda: load_scenario("stone_outer_edge", dict([parse_change(text)])))


@hostile(
    some.lists(some.tuples(some.sampled_from(["scenario", "controller", "controller.guard", "physics.friction",
        "stones.0.height_m", "pushes.9.x", "token", "reference.kind"]) | some.text(max_size=8),
        some.sampled_from(["stand_left", "two-part", "../../etc/passwd", "nan"]) | values), max_size=6)
)  # fmt: skip
def test_a_link_is_refused_or_names_a_shipped_scenario(pairs):
    """A query as a foreign page may write it."""
    query = "&".join(f"{key}={value}" for key, value in pairs)
    target = outcome(lambda: link_target(read_link(query)))
    assert target is None or target[0].name in shipped_scenarios()


@hostile(keyed(SETTINGS, anything, 8) | some.binary(max_size=200))
def test_a_preset_is_refused_or_holds_valid_settings(preset):
    """A settings file that somebody uploads."""
    content = preset if isinstance(preset, bytes) else _toml(preset)
    table = outcome(lambda: read_preset(content))
    assert table is None or ControllerSettings(**table)


def _toml(table) -> bytes:
    lines = [f"{key} = {json.dumps(value, default=str)}" for key, value in table.items()]
    return "\n".join(["[controller]", *lines]).encode(errors="replace")


@pytest.fixture(autouse=True, scope="module")
def saved(folder):
    """A good run, as every kind of file."""
    from surefoot import run

    done = run("stone_outer_edge", changes={"duration_s": 0.02})
    kept = SavedRun(done.columns, done.table, json.loads(json.dumps(done.manifest)))
    path = folder / "run.npz.partial"
    writer = PartialWriter(path, kept.columns, kept.manifest)
    for half in np.split(kept.table, 2):
        writer.add(half, [])
    writer.close()
    hostile.kept = kept
    hostile.files = {".npz": npz_bytes(kept), ".parquet": parquet_bytes(kept), PARTIAL: path.read_bytes()}


@hostile(some.tuples(some.sampled_from([".npz", ".parquet", PARTIAL]), some.lists(
    some.tuples(some.integers(0, 10**6), some.integers(0, 255), some.booleans()), min_size=1, max_size=4)))  # fmt: skip
def test_a_damaged_run_is_refused_or_opens(example):
    """A saved run with some bytes changed."""
    suffix, places = example
    file = hostile.folder / f"damaged{suffix}"
    file.write_bytes(damaged(hostile.files[suffix], places))
    outcome(lambda: read_run(file))


ENTRIES = "format robot support stones ground events scenario settings summary script interrupted_s".split()


@hostile(keyed(ENTRIES, some.recursive(numbers | some.text(max_size=9), lambda x: some.lists(x, max_size=4)), 5))
def test_a_run_with_a_foreign_manifest_is_refused_or_opens(entries):
    """A saved run whose manifest says anything."""
    file = io.BytesIO()
    manifest = json.dumps({**hostile.kept.manifest, **entries})
    np.savez(file, table=hostile.kept.table, columns=list(hostile.kept.columns), manifest=manifest)
    (hostile.folder / "foreign.npz").write_bytes(file.getvalue())
    outcome(lambda: read_run(hostile.folder / "foreign.npz"))


arrays = some.one_of(
    some.lists(some.floats(allow_nan=True, allow_infinity=True), max_size=16).map(np.array),
    some.lists(some.floats(-1e9, 1e9), min_size=15, max_size=15).map(np.array),
    some.sampled_from([np.zeros((15, 1)), np.zeros(15, dtype=object), np.full(15, "x"), np.zeros(15, dtype=complex)]),
    plain,
)


@hostile(some.tuples(arrays, arrays, arrays, some.sampled_from(list(Status)) | plain, plain))
def test_what_a_controller_gives_is_refused_or_can_be_torques(parts):
    """A plug-in's output."""
    torques, zmp, delta, status, flag = parts
    output = ControlOutput(
        torques=torques, zmp_wanted_in_world=zmp, zmp_commanded_in_world=zmp, delta_commanded=delta, status=status,
        guard_active=flag, guard_relaxed=False, gate_active=False, infeasible=False,
    )  # fmt: skip
    fault = output_fault(output, 15)
    if fault is None:
        assert torques.shape == (15,)
        assert np.isfinite(torques).all()
        assert np.abs(torques).max() < 1e7
    else:
        assert len(fault.splitlines()) == 1


@pytest.fixture(autouse=True, scope="module")
def live():
    """A live run that takes all that a page, or somebody who pretends to be one, may send."""
    hostile.playback = Playback("stand_left", "two-part")
    return hostile.playback


small = some.floats(-0.3, 0.3) | some.sampled_from([0.01, 0.05])
given_values = some.one_of(small, anything)
point = some.tuples(small, small, small) | anything
commands = some.one_of(
    some.builds(cmd.PlaceStone, x_m=given_values, y_m=given_values, height_m=given_values, size_m=given_values,
                shape=some.sampled_from(["box", "wedge", "half-ball"]) | plain),
    some.builds(cmd.PlaceStoneAtSole, place=some.sampled_from(["toe", "outer edge"]) | plain, height_m=given_values,
                size_m=given_values),
    some.builds(cmd.MoveStone, number=some.integers(0, 3) | plain, x_m=given_values, y_m=given_values),
    some.builds(cmd.RemoveStone, some.integers(0, 3) | plain),
    some.builds(cmd.PushNow, direction_deg=given_values, impulse_ns=given_values, duration_s=given_values,
                link=some.sampled_from(["com", "trunk"]) | plain),
    some.builds(cmd.HoldLink, client_id=some.text(max_size=3), link=some.sampled_from(["trunk", "hand"]) | plain,
                point=point, target=point),
    some.builds(cmd.TiltGround, slope_deg=given_values, direction_deg=given_values, duration_s=given_values),
    some.builds(cmd.SetFriction, given_values),
    some.builds(cmd.SetController, some.sampled_from(["two-part", "soft-qp", "magic"]) | plain),
    some.builds(cmd.ChangeSettings, keyed(SETTINGS, anything, 2)),
    some.builds(cmd.UseSettings, settings=keyed(SETTINGS, anything, 2), label=some.just("x")),
    some.builds(cmd.SetSpeed, given_values),
    some.builds(cmd.Seek, given_values),
    some.builds(cmd.LoadScenario, some.sampled_from(["stand_left", "../x", "/etc/passwd"])),
)  # fmt: skip


@hostile(commands)
def test_a_command_is_refused_or_obeyed_and_the_page_shows_numbers(command):
    """Values of widgets, and messages of a foreign page."""
    playback = hostile.playback
    if outcome(lambda: check_command(command) or command):  # the session's door
        playback.apply(command)
    for _ in range(3):
        if not playback.live.ended:
            playback.tick()
    snapshot = playback.snapshot()
    assert np.isfinite(snapshot.geometry.qpos).all()
    assert np.isfinite(snapshot.geometry.com).all()
    assert all(len(event.text.splitlines()) == 1 and len(event.text) <= LONGEST_LINE for event in snapshot.events)
    if playback.live.ended:
        playback.apply(cmd.Reset())
