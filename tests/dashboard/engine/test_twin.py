"""Twin run: the same at the same tick for both; where they go apart and who falls is told."""

import numpy as np
import pytest

from surefoot.dashboard.engine.coordinator import Coordinator, for_first, for_twin, split
from surefoot.dashboard.engine.twin_comparison import Comparison
from surefoot.dashboard.engine.worker import InlineWorker
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.signals import COMPARED, TWIN_COLUMNS
from surefoot.dashboard.messages.snapshot import DIVERGED_M
from surefoot.dashboard.panels.twin.twin_plots import Line
from surefoot.dashboard.panels.twin.twin_strip import strip_html

STONE = cmd.PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06)


@pytest.fixture
def coordinator():
    return Coordinator(InlineWorker(Playback("stand_left", "two-part")), InlineWorker)


def perform(coordinator, ticks, *commands):
    """Obey, then tick in requests of 16 as long as anything plays; returns the last snapshot."""
    coordinator.turn(commands, 0, snapshot=True)
    while ticks > 0 and coordinator.playing:
        coordinator.turn((), min(ticks, 16), snapshot=True)
        ticks -= 16
    coordinator.turn((), 0, snapshot=True)
    return coordinator.snapshot(1, 1.0)


def rows(times, y):
    table = np.zeros((len(times), len(COMPARED)))
    table[:, 0], table[:, COMPARED.index("com_y_m")] = times, y
    return table


def test_a_line_of_a_comparison_that_does_not_exist_is_refused_with_those_that_do():
    with pytest.raises(ValueError, match=r"no signal 'com_z_mm'; there are: time_s, com_x_mm, .*sagittal_twin_nm"):
        Line("com_z_mm", (0, 0, 0))


def test_equal_controllers_stay_equal_to_the_bit(coordinator):
    perform(coordinator, 48, cmd.StartTwin("two-part"))
    push = cmd.PushNow(direction_deg=90.0, impulse_ns=8.0)
    snapshot = perform(coordinator, 640, STONE, push, cmd.SetFriction(0.7))
    one, two = snapshot.geometry, snapshot.twin.other.geometry
    assert snapshot.time_s == snapshot.twin.other.time_s == pytest.approx(0.688)
    assert one.qpos.tobytes() == two.qpos.tobytes()
    assert one.stones == two.stones
    assert one.com[1] > 0.0
    assert snapshot.twin.divergence is None
    table = snapshot.twin.table
    assert table.shape == (28, len(TWIN_COLUMNS))
    assert (table[:, 1:3] == 0.0).all()
    assert np.ptp(table[:, 5]) > 1.0


def test_both_have_the_same_sensors_and_the_same_errors(coordinator):
    perform(coordinator, 16, cmd.ChangeSensing({"preset": "robot", "seed": 4}, "anchor"))
    snapshot = perform(coordinator, 48, cmd.StartTwin("two-part"))
    assert snapshot.sensing == snapshot.twin.other.sensing
    assert snapshot.sensing.sensors.seed == 4
    one, two = snapshot.geometry.believed, snapshot.twin.other.geometry.believed
    assert one.qpos.tobytes() == two.qpos.tobytes()
    snapshot = perform(coordinator, 48, cmd.ChangeSensing(estimator="invariant-ekf"))  # for both
    assert snapshot.time_s == snapshot.twin.other.time_s == pytest.approx(0.048)
    assert snapshot.twin.other.sensing.estimator == "invariant-ekf"
    assert snapshot.geometry.believed.qpos.tobytes() == snapshot.twin.other.geometry.believed.qpos.tobytes()


def test_a_twin_begins_with_the_first_at_the_start_and_shares_what_is_not_its_own(coordinator):
    perform(coordinator, 100, cmd.ChangeSettings({"com_stiffness": 70.0}), cmd.SetFriction(0.6))
    snapshot = perform(coordinator, 0, cmd.StartTwin("soft-qp", {"com_damping": 20.0}))
    other = snapshot.twin.other
    assert (snapshot.time_s, other.time_s, snapshot.run) == (0.0, 0.0, 2)
    assert (other.controller, other.friction) == ("soft-qp", 0.6)
    assert (other.settings.com_stiffness, other.settings.com_damping) == (70.0, 20.0)
    assert (snapshot.controller, snapshot.settings.com_damping) == ("two-part", 14.0)

    own = (
        cmd.SetTwinController("two-part"),
        cmd.ChangeTwinSettings({"guard": False}),
        cmd.ChangeSettings({"latched": True}),
    )
    snapshot = perform(coordinator, 32, *own)
    other = snapshot.twin.other
    assert (other.controller, other.settings.guard, other.settings.latched) == ("two-part", False, False)
    assert (snapshot.settings.guard, snapshot.settings.latched) == (True, True)
    assert perform(coordinator, 16, cmd.StopTwin()).twin is None


def test_a_stone_makes_one_fall_and_the_divergence_is_named_after_it(coordinator):
    perform(coordinator, 96, cmd.StartTwin("optimization"))
    snapshot = perform(coordinator, 6000, STONE)
    twin, other = snapshot.twin, snapshot.twin.other
    assert snapshot.balance.fall_cause is None
    assert other.balance.fall_cause == "support_lost"
    assert other.balance.ended and not other.playing
    assert snapshot.playing  # the first one goes on
    assert snapshot.time_s > other.time_s
    assert 0.096 < twin.divergence.time_s < other.balance.fall_time_s
    assert twin.divergence.distance_mm == pytest.approx(1e3 * DIVERGED_M, abs=0.1)
    assert twin.divergence.after.kind == "stone"
    assert twin.marks[0].kind == "stone"
    assert twin.table[-1, 0] == pytest.approx(other.time_s, abs=0.026)
    texts = {event.kind: event.text for event in snapshot.events}
    assert "after: stone 10 mm high" in texts["divergence"]
    assert texts["fall"].startswith("twin: FALL at")
    html = strip_html(snapshot)
    assert "first divergence" in html and "twin · optimization" in html and "support_lost" in html and "stands" in html

    before = other.time_s
    snapshot = perform(coordinator, 64, cmd.TogglePlay())
    assert not snapshot.playing
    snapshot = perform(coordinator, 64, cmd.TogglePlay())
    assert snapshot.playing
    assert snapshot.twin.other.time_s == before
    assert not any(event.kind == "error" for event in snapshot.events)
    snapshot = perform(coordinator, 32, cmd.Reset())
    assert (snapshot.twin.divergence, snapshot.twin.marks, len(snapshot.twin.table)) == (None, (), 2)
    assert snapshot.time_s == snapshot.twin.other.time_s


def test_both_go_back_in_time_and_part_again_at_the_same_tick(coordinator):
    perform(coordinator, 96, cmd.StartTwin("optimization"))
    found = perform(coordinator, 320, STONE).twin.divergence
    snapshot = perform(coordinator, 0, cmd.Seek(0.15))
    assert (snapshot.time_s, snapshot.twin.other.time_s) == pytest.approx((0.15, 0.15))
    assert not snapshot.playing
    snapshot = perform(coordinator, 20, cmd.Play())
    assert snapshot.twin.divergence is None
    assert [mark.kind for mark in snapshot.twin.marks] == ["stone"]
    assert perform(coordinator, 246).twin.divergence == found
    snapshot = perform(coordinator, 0, cmd.Step(-10))
    assert snapshot.time_s == snapshot.twin.other.time_s == pytest.approx(0.406)


def test_an_error_in_one_pauses_both(coordinator, monkeypatch, capsys):
    perform(coordinator, 32, cmd.StartTwin("two-part"))

    def explode():
        raise RuntimeError("a bug")

    monkeypatch.setattr(coordinator.lanes[1].worker.playback.live.simulation, "tick", explode)
    assert coordinator.turn((), 16, snapshot=False).errors == 1
    snapshot = perform(coordinator, 160)
    assert not coordinator.playing
    assert not snapshot.playing
    assert any("twin: internal error" in event.text for event in snapshot.events)
    assert "a bug" in capsys.readouterr().err
    snapshot = perform(coordinator, 32, cmd.Reset())
    assert snapshot.time_s == snapshot.twin.other.time_s == pytest.approx(0.032)


def test_a_twin_that_cannot_be_is_told_and_the_first_goes_on(coordinator):
    snapshot = perform(coordinator, 32, cmd.StartTwin("no-such-controller"))
    assert snapshot.twin is None
    assert snapshot.time_s == pytest.approx(0.032)
    assert "no twin: controller = 'no-such-controller'" in snapshot.events[0].text


def test_without_processes_it_plays_here():
    def no_process():
        raise OSError("no more processes")

    coordinator = Coordinator(InlineWorker(Playback("stand_left", "two-part")), no_process)
    assert perform(coordinator, 32, cmd.StartTwin("soft-qp")).twin.other.time_s == pytest.approx(0.032)


@pytest.mark.parametrize(
    ("command", "first", "twin"),
    [
        (cmd.SetController("soft-qp"), True, False),
        (cmd.ChangeSettings({"guard": False}), True, False),
        (cmd.ResetSettings(), True, False),
        (cmd.StartTwin("soft-qp"), False, False),
        (cmd.StopTwin(), False, False),
        (cmd.SetTwinController("soft-qp"), False, cmd.SetController("soft-qp")),
        (cmd.ChangeTwinSettings({"guard": False}), False, cmd.ChangeSettings({"guard": False})),
        (STONE, True, True),
        (cmd.PushNow(direction_deg=0.0, impulse_ns=1.0), True, True),
        (cmd.SetSpeed(0.5), True, True),
        (cmd.Reset(), True, True),
        (cmd.Seek(1.0), True, True),
        (cmd.LoadScenario("swing_inward"), True, True),
    ],
    ids=lambda value: type(value).__name__,
)
def test_who_is_asked_what(command, first, twin):
    assert for_first(command) == (command if first else None)
    assert for_twin(command) == (command if twin is True else twin or None)


def test_one_that_lies_is_not_asked_to_play_again():
    commands = (cmd.TogglePlay(), STONE)
    assert split(commands, playing=False, first_over=False, twin_over=True) == ((cmd.Play(), STONE), (STONE,))
    assert split(commands, playing=True, first_over=True, twin_over=False) == ((cmd.Pause(), STONE),) * 2


def test_the_first_tick_more_than_a_millimetre_apart_and_back_in_time():
    comparison, times = Comparison(), np.arange(100) * 1e-3
    stone = Event(0.010, EventKind.STONE, "a stone")
    comparison.note(stone)
    comparison.note(Event(0.020, EventKind.FALL, "not done to anybody"))
    apart = np.where(np.arange(100) < 60, 0.5e-3, 1.5e-3)
    comparison.add(rows(times, 0.0), rows(times, apart))
    assert comparison.divergence.time_s == pytest.approx(0.060)
    assert comparison.divergence.distance_mm == pytest.approx(1.5)
    assert comparison.divergence.after == stone
    assert comparison.table()[:, 0] == pytest.approx([0.0, 0.025, 0.050, 0.075])
    comparison.add(rows(times[40:50], 0.0), rows(times[40:50], 0.0))
    assert comparison.divergence is None
    assert comparison.marks == (stone,)
    assert comparison.table()[:, 0] == pytest.approx([0.0, 0.025])
