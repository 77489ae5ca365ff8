"""Rows for the plots: what they say, how long they are kept, and that thinning them loses no peak."""

import csv
import io
import pickle
from types import SimpleNamespace

import numpy as np
import pytest
import viser
from PIL import Image

from surefoot.dashboard.live.observation.plot_rows import LONGEST_WINDOW_S, TRACE_EVERY_TICKS, TraceLog, edges_at
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.signals import SIGNALS, TRACE_COLUMNS
from surefoot.dashboard.panels.plots.plots import PLOT_BY_KEY, PlotsPanel, traces_csv, traces_png
from surefoot.dashboard.ui.decimate import decimate
from surefoot.dashboard.ui.plot_kinds import PLOTS, Trace
from surefoot.geometry.polygon import convex_hull


def column(table, name):
    return table[:, TRACE_COLUMNS.index(name)]


def row(time_s):
    return (time_s, *[0.0] * (len(TRACE_COLUMNS) - 1))


@pytest.fixture(scope="module")
def pushed():
    playback = Playback("stand_left", "two-part")
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=12.0))
    for _ in range(600):
        playback.tick()
    return playback


def test_every_plot_shows_signals_of_the_one_unit_that_its_title_tells(pushed):
    units = {signal.key: signal.unit for signal in SIGNALS}
    assert len(units) == len(SIGNALS)
    for plot in PLOTS:
        shown = {units[trace.source] for trace in plot.traces(pushed.live.observer.limits) if trace.source in units}
        assert len(shown) == 1, plot.key
        assert f"[{shown.pop()}]" in plot.title


def test_a_line_of_a_signal_that_does_not_exist_is_refused_with_those_that_do():
    with pytest.raises(ValueError, match=r"no signal 'zmp_z_mm'; there are: time_s, zmp_x_mm, .*tick_us"):
        Trace("ZMP", "zmp_z_mm", (0, 0, 0))


def test_delta_and_forces_agree_with_the_recorder(pushed):
    table, recorded = pushed.live.observer.traces(), pushed.live.simulation.recorder
    ticks = np.arange(len(table)) * TRACE_EVERY_TICKS
    for ours, theirs, scale in (
        ("delta_measured_x_nm", "delta_measured_x_nm", 1.0), ("delta_commanded_y_nm", "delta_commanded_y_nm", 1.0),
        ("zmp_margin_mm", "zmp_margin_m", 1e3),
    ):  # fmt: skip
        np.testing.assert_allclose(column(table, ours), scale * recorded.column(theirs)[ticks], atol=1e-6)


def test_the_edges_are_those_beside_the_measured_zmp(pushed):
    """The sole is wider at its toe: as the ZMP moves forward, the side edges must move apart."""
    sole = pushed.live.simulation.robot.feet[0].sole
    rear, front, right, left = edges_at(sole, np.array((0.17, 0.0)), np.zeros(2))
    assert (rear, front, right, left) == pytest.approx((-120.0, 170.0, -90.0, 90.0))
    rear, front, right, left = edges_at(sole, np.array((-0.12, 0.0)), np.zeros(2))
    assert (right, left) == pytest.approx((-60.0, 60.0))
    assert edges_at(sole, np.array((-9.0, 0.0)), np.zeros(2)) == pytest.approx((-120.0, 170.0, -60.0, 60.0))


def test_in_double_support_the_edges_are_those_of_both_soles():
    both = convex_hull([(-0.1, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.1, 0.2)])
    assert edges_at(both, np.array((0.0, 0.1)), np.array((0.0, 0.0))) == pytest.approx((-100.0, 200.0, -200.0, 200.0))


def test_rows_are_kept_for_the_longest_window_and_no_longer():
    log, count = TraceLog(), round(1.2 * LONGEST_WINDOW_S * 1000 / TRACE_EVERY_TICKS)
    for i in range(count):
        log.add(row(0.01 * i))
    times = log.table()[:, 0]
    np.testing.assert_allclose(np.diff(times), 0.01)
    assert times[-1] == pytest.approx(0.01 * (count - 1))
    assert LONGEST_WINDOW_S - 0.02 <= times[-1] - times[0] <= LONGEST_WINDOW_S + 1.0


def test_a_copy_goes_its_own_way():
    log = TraceLog()
    for i in range(150):
        log.add(row(float(i)))
    copy = log.copy()
    log.add(row(1000.0))
    assert copy.table()[-1, 0] == 149.0
    assert log.table()[-1, 0] == 1000.0


@pytest.mark.parametrize("rows", [10, 399, 400, 401, 800, 2999])
def test_thinning_keeps_every_extreme_and_the_order_of_time(rows):
    rng = np.random.default_rng(rows)
    table = np.column_stack((0.01 * np.arange(37, rows + 37), rng.normal(size=(rows, 3))))
    table[rng.integers(rows), 1] = 1e3
    thinned = decimate(table, 400)
    assert len(thinned) <= 400
    assert (np.diff(thinned[:, 0]) >= 0.0).all()
    np.testing.assert_array_equal(thinned.max(axis=0)[1:], table.max(axis=0)[1:])
    np.testing.assert_array_equal(thinned.min(axis=0)[1:], table.min(axis=0)[1:])
    assert (thinned[0, 0], thinned[-1, 0]) == (table[0, 0], table[-1, 0])


def test_thinned_rows_rise_and_fall_where_the_rows_do():
    time = 0.01 * np.arange(2000)
    thinned = decimate(np.column_stack((time, time, -time)), 400)
    assert (np.diff(thinned[:, 1]) > 0.0).all()
    assert (np.diff(thinned[:, 2]) < 0.0).all()


def test_a_peak_keeps_its_shape_while_the_window_moves():
    time = 0.01 * np.arange(3000)
    table = np.column_stack((time, np.where(np.arange(3000) == 1500, 1.0, 0.0)))
    shapes = []
    for start in range(0, 40, 7):
        thinned = decimate(table[start : start + 2400], 400)
        shapes.append(tuple(thinned[thinned[:, 1] > 0.0].ravel()))
    assert len(set(shapes)) == 1


def test_unknown_values_leave_a_gap_and_hide_no_known_ones():
    values = np.full(1000, np.nan)
    values[300:500] = 7.0
    thinned = decimate(np.column_stack((0.01 * np.arange(1000), values)), 400)
    assert np.isnan(thinned[0, 1]) and np.isnan(thinned[-1, 1])
    assert np.nanmax(thinned[:, 1]) == 7.0


def test_without_an_estimator_there_are_no_errors_to_plot(pushed):
    for kind in PLOTS:
        lines = [trace.values(pushed.live.observer.traces()) for trace in kind.traces(pushed.live.observer.limits)]
        assert kind.believed == all(np.isnan(line).all() for line in lines)


def test_errors_and_their_band_are_those_of_the_record():
    playback = Playback("stand_left", "two-part")
    playback.apply(cmd.ChangeSensing({"preset": "robot"}, "anchor"))
    for _ in range(120):
        playback.tick()
    table, recorder, limits = (
        playback.live.observer.traces(),
        playback.live.simulation.recorder,
        playback.live.observer.limits,
    )
    ticks = np.arange(len(table)) * TRACE_EVERY_TICKS
    for key, error, sigma, scale in (
        ("dcm_error", "dcm_error_{}_m", "dcm_sigma_{}_m", 1e3),
        ("tilt_error", "orientation_error_{}_rad", "orientation_sigma_{}_rad", 180.0 / np.pi),
    ):
        lines = [trace.values(table) for trace in PLOT_BY_KEY[key].traces(limits)]
        errors = [scale * recorder.column(error.format(axis))[ticks] for axis in "xy"]
        bands = [3.0 * scale * sign * recorder.column(sigma.format(axis))[ticks] for axis in "xy" for sign in (-1, 1)]
        np.testing.assert_allclose(lines, [*errors, *bands], rtol=1e-9, err_msg=key)
        assert np.abs(lines[:2]).max() > 0.0
        assert (np.array(lines[3]) > 0.0).all()


def test_plots_of_errors_can_be_chosen_where_there_is_an_estimator():
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    playback = Playback("stand_left", "two-part")
    panel = PlotsPanel(SimpleNamespace(gui=server.gui, newest=playback.snapshot))
    boxes = {handle.label: handle for handle in server.gui._gui_input_handle_from_uuid.values()}
    box = boxes["DCM error"]
    assert not box.visible and boxes["Margins"].visible
    playback.apply(cmd.ChangeSensing({"preset": "robot"}, "anchor"))
    panel.show(playback.snapshot())
    assert box.visible
    box.value = True
    for callback in box._impl.update_cb:
        callback(SimpleNamespace(client=box, target=box))
    assert panel.chosen[-1] == "dcm_error"
    playback.apply(cmd.ChangeSensing(estimator="truth"))
    panel.show(playback.snapshot())
    assert "dcm_error" not in panel.chosen
    assert not box.visible and not box.value
    server.stop()


def test_the_csv_holds_every_row_of_what_is_plotted(pushed):
    table = pushed.live.observer.traces()
    text = traces_csv([kind for kind in PLOTS if kind.key == "ankles"], pushed.live.observer.limits, table).decode()
    lines = list(csv.reader(io.StringIO(text)))
    assert lines[0] == ["time_s", "ankle_frontal_nm", "ankle_sagittal_nm"]
    assert len(lines) == len(table) + 1
    assert float(lines[-1][1]) == pytest.approx(table[-1, TRACE_COLUMNS.index("ankle_frontal_nm")], rel=1e-5)


def test_the_picture_shows_the_lines_in_their_colours(pushed):
    data = traces_png(PLOTS[:2], pushed.live.observer.limits, pushed.live.observer.traces())
    pixels = np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)
    for trace in PLOTS[0].traces(pushed.live.observer.limits):
        assert (np.abs(pixels - trace.colour).max(axis=2) < 40).sum() > 20, trace.label
    assert traces_png((), pushed.live.observer.limits, pushed.live.observer.traces()).startswith(b"\x89PNG")


def test_what_the_page_is_sent_can_cross_to_another_process(pushed):
    view = pickle.loads(pickle.dumps(pushed.live.observer.headroom()))
    assert view == pushed.live.observer.headroom()
    assert pickle.loads(pickle.dumps(pushed.live.observer.geometry())).stones == ()
