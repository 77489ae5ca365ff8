"""Sliders of lengths, impulses and moments go with the robot: Bip's as they are described, a smaller one's smaller."""

from types import SimpleNamespace

import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages.commands import ChooseRobot, PlaceStone, PushNow
from surefoot.dashboard.panels.disturb.disturb import DisturbPanel
from surefoot.dashboard.panels.disturb.stones import StonesPanel
from surefoot.dashboard.panels.walk.walk import WalkPanel
from surefoot.dashboard.ui.setting_widgets import SettingWidgets
from surefoot.dashboard.ui.sliders import scaled_range, steps_within

BIP = {
    "Impulse [N·s]": (1, 100, 1, 20),
    "Stone height [mm]": (1, 40, 1, 10),
    "Stone size [mm]": (20, 200, 5, 60),
    "Step length [m]": (-0.3, 0.5, 0.01, 0.2),
    "Step width [m]": (0.16, 0.4, 0.01, 0.22),
    "Foot lift [m]": (0.01, 0.15, 0.005, 0.05),
    "Stones under steps [mm]": (0, 100, 5, 0),
    "δ_P ref sagittal [N·m]": (-900, 900, 1, 0),
    "δ_P ref frontal [N·m]": (-900, 900, 1, 0),
    "Step period [s]": (0.3, 3.0, 0.05, 0.8),
    "Direction [°]": (-180, 180, 5, 90),  # what goes with no size
    "ZMP margin [-]": (0.1, 1.0, 0.01, 0.95),
}
SAME = ("Direction [°]", "ZMP margin [-]")


class Panels:
    """The panels with such sliders, of one run.

    Args:
        server: where they are.
        playback: the run.
    """

    def __init__(self, server, playback) -> None:
        self._gui, self._playback, first = server.gui, playback, playback.snapshot()
        context = SimpleNamespace(
            gui=server.gui, send=playback.apply, send_stone=playback.apply, newest=playback.snapshot
        )
        self._panels = [kind(context) for kind in (DisturbPanel, StonesPanel, WalkPanel)]
        self._delta = SettingWidgets(server.gui, "delta", first.settings, playback.apply)
        self.show()

    def show(self) -> None:
        snapshot = self._playback.snapshot()
        for panel in self._panels:
            panel.show(snapshot)
        self._delta.suit(snapshot.robot)

    def sliders(self) -> dict[str, tuple[float, ...]]:
        handles = {handle.label: handle for handle in self._gui._gui_input_handle_from_uuid.values()}
        return {label: (h.min, h.max, h.step, h.value) for label in BIP for h in [handles[label]]}

    def hint(self, label: str) -> str:
        return next(h.hint for h in self._gui._gui_input_handle_from_uuid.values() if h.label == label)


def test_bip_s_are_as_described_and_another_robot_s_in_proportion(server):
    playback = Playback("stand_left", "two-part")
    panels = Panels(server, playback)
    assert panels.sliders() == {label: pytest.approx(ends) for label, ends in BIP.items()}
    playback.apply(ChooseRobot("offset"))
    panels.show()
    small = panels.sliders()
    for label, (low, high, step, value) in small.items():
        assert low <= value <= high
        assert step <= BIP[label][2]
        if label in SAME:
            assert (low, high) == pytest.approx(BIP[label][:2])
        else:
            assert high < 0.9 * BIP[label][1]
    assert f"{small['δ_P ref sagittal [N·m]'][1]:g} [N·m]" in panels.hint("δ_P ref sagittal [N·m]")
    playback.apply(ChooseRobot("bip"))
    panels.show()
    assert panels.sliders() == {label: pytest.approx(ends) for label, ends in BIP.items()}


@pytest.mark.parametrize("robot", ["bip", "offset"])
def test_what_the_ends_of_the_sliders_say_is_taken(server, robot):
    playback = Playback("stand_left", "two-part")
    playback.apply(ChooseRobot(robot))
    sliders = Panels(server, playback).sliders()
    said = len(playback.snapshot().events)
    for end in (0, 1):
        size_m, height_m = (1e-3 * sliders[f"Stone {what} [mm]"][end] for what in ("size", "height"))
        playback.apply(PlaceStone(x_m=1.0, y_m=1.0, height_m=height_m, size_m=size_m))
        playback.apply(PushNow(direction_deg=0.0, impulse_ns=sliders["Impulse [N·s]"][end]))
    events = playback.snapshot().events[: len(playback.snapshot().events) - said]
    assert [event.kind.value for event in events] == ["push", "stone"] * 2


@pytest.mark.parametrize(
    ("ratio", "ends"), [(1.0, (-900.0, 900.0, 1.0)), (0.6, (-540.0, 540.0, 1.0)), (0.1864, (-170.0, 170.0, 0.1))]
)
def test_a_scaled_range_has_two_digits(ratio, ends):
    assert scaled_range(-900.0, 900.0, 1.0, ratio) == pytest.approx(ends)


@pytest.mark.parametrize(
    ("own", "step", "ratio", "ends"),
    [
        ((-0.3, 0.5), 0.01, 1.0, (-0.3, 0.5, 0.01)),
        ((0.145, 0.364), 0.01, 0.9, (0.15, 0.36, 0.01)),
        ((0.0509, 0.127), 0.01, 0.39, (0.051, 0.127, 0.001)),
    ],
)
def test_the_steps_of_a_slider_lie_within_what_the_robot_takes(own, step, ratio, ends):
    assert steps_within(*own, step, ratio) == pytest.approx(ends)
