"""Every first cause of a walk's fall is named when exactly that happens: short walks in the real simulation."""

import math
import re

import numpy as np
import pytest

from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.gait.footsteps import AHEAD_M, ASIDE_M
from surefoot.gait.touchdown import TOUCH_N
from surefoot.resources import help_text
from surefoot.robot.description import load_robot
from surefoot.simulation.event_texts import fall_text
from surefoot.simulation.external_forces import Push
from surefoot.simulation.falls import FALL_CAUSES, SUPPORT_LOST_N
from surefoot.simulation.walk_causes import (
    FAR_M,
    LATE_S,
    SLID_M,
    STRAIGHT_RAD,
    TIPPED_RAD,
    TRIP,
    WINDOW_S,
    WalkWatch,
    first_cause_text,
    walk_cause_texts,
)

THREE_STEPS = {"reference.steps": 3, "reference.step_period_s": 0.6, "duration_s": 4.5}
# In the right foot's way, higher than it is lifted and too wide to slip past
POST = {"x_m": 0.3, "y_m": -0.22, "height_m": 0.1, "size_m": [0.03, 0.3], "lying": True}
TRIPS = {**THREE_STEPS, "reference.step_length_m": 0.3, "stones": [POST]}
FALLS = {
    "late_landing": {
        **THREE_STEPS,
        "reference.step_length_m": 0.4,
        "ledges": [{"x_m": 0.2, "height_m": -0.12}],  # the whole of the first foot is beyond it
    },
    "out_of_reach": {"duration_s": 4.5, "footsteps": [{"foot": "left", "x_m": 0.6, "y_m": 0.38}]},
    "slip": {**THREE_STEPS, "physics.friction": 0.05},
    "tipped_sole": {**THREE_STEPS, "ledges": [{"x_m": 0.18, "height_m": -0.2}]},  # the first foot lands half beyond it
    "missed_capture": {
        **THREE_STEPS,
        "pushes": [
            {"start_s": 1.2, "duration_s": 0.1, "impulse_ns": 80.0, "direction_deg": -90.0}
        ],  # to the stance side
    },
}


def simulation_of(changes: dict):
    scenario = load_scenario("walk_flat", changes)
    return build_simulation(scenario, "two-part", rows=scenario.ticks).simulation


def until_it_falls(simulation, ticks: int = 5_000):
    for _ in range(ticks):
        if simulation.tick().fall_cause is not None:
            return simulation
    raise AssertionError("it has not fallen")


@pytest.mark.parametrize("name", FALLS)
def test_each_first_cause_is_reached_by_a_construction_of_its_own(name):
    simulation = until_it_falls(simulation_of(FALLS[name]))
    assert simulation.fall_first.name == name
    assert simulation.fall_time_s - WINDOW_S <= simulation.fall_first.time_s < simulation.fall_time_s
    assert simulation.fallen in FALL_CAUSES
    meaning = walk_cause_texts(simulation.robot.sizes)[name]
    assert f"; first cause: {name} at {simulation.fall_first.time_s:.2f} s: {meaning}" in fall_text(simulation)


def test_a_foot_that_meets_a_post_trips_when_it_touches_it():
    """The time is that of the first contact in mid-air, as the swing foot's force has it."""
    simulation = simulation_of(TRIPS)
    touched = None
    for _ in range(5_000):
        if simulation.fallen is not None:
            break
        before = simulation.gait.swinging
        result = simulation.tick()
        swinging = simulation.gait.swinging
        if touched is None and simulation.gait.made == 1 and before == swinging == 1:
            force = simulation.plant.feet()[1].force
            since_s = simulation.time_s - simulation.gait.began_s
            if since_s > 0.05 and np.abs(force[:2]).max() > 30.0:
                touched = result.terms.state.time_s
    assert simulation.fallen is not None
    assert simulation.fall_first.name == TRIP
    assert simulation.fall_first.time_s == pytest.approx(touched, abs=0.01)


def test_a_walk_that_goes_well_notes_no_fault():
    simulation = simulation_of({**THREE_STEPS, "reference.steps": 2, "reference.step_length_m": 0.3})
    for _ in range(2_400):
        assert simulation.tick().fall_cause is None
    assert simulation.fall_first is None
    watch = simulation.walk_watch
    assert watch.first_cause("trunk_tilt", simulation.time_s).name == "trunk_tilt"  # there is nothing before it


def test_what_was_long_ago_is_not_the_cause_and_what_stops_a_run_is():
    simulation = until_it_falls(simulation_of(TRIPS))
    watch, fell = simulation.walk_watch, simulation.fall_time_s
    assert watch.first_cause("pelvis_low", fell) == simulation.fall_first
    assert watch.first_cause("pelvis_low", fell + 1.01 * WINDOW_S).name == "pelvis_low"
    for stops in ("nan", "controller_error"):
        assert watch.first_cause(stops, fell).name == stops
        assert watch.first_cause(stops, fell).time_s == fell


def test_a_controller_that_fails_in_a_walk_is_its_own_first_cause(scripted):
    simulation = simulation_of(THREE_STEPS)
    simulation.controller = scripted(lambda tick: np.full(15, np.nan if tick == 5 else 0.0))
    until_it_falls(simulation, 10)
    assert simulation.fall_first.name == simulation.fallen == "controller_error"


@pytest.mark.parametrize(("landing", "beyond_m", "missed"), [(0.2, 0.01, True), (0.2, -0.01, False), (0.9, 0.01, True)])
def test_a_capture_is_missed_beyond_the_bound_of_the_linear_pendulum(landing, beyond_m, missed):
    """Forwards, in a walk that turns: toe (1 - e) + (0.6 + toe) e ahead of the ankle that stands, e = e^(-omega T)."""
    changes = {**THREE_STEPS, "reference.steps": 2, "reference.step_length_m": 0.0, "reference.turn_deg_per_step": 10.0}
    simulation = simulation_of(changes)
    while simulation.gait.made == 0 or simulation.gait.swinging is None:
        simulation.tick()  # until the left foot stands, turned, and the right one swings
    single_s = simulation.gait.timing.single_s
    while (simulation.time_s - simulation.gait.began_s) < landing * single_s:
        result = simulation.tick()
    omega, now = 3.3, result.terms.state.time_s
    left = math.exp(-omega * (single_s - (now - simulation.gait.began_s)))
    toe = simulation.robot.feet[0].sole.vertices[:, 0].max()
    bound = (1.0 - left) * toe + left * (AHEAD_M[1] + toe)
    stands = result.terms.feet[0]
    ahead = stands.rotation_foot_to_world[:2, 0]
    assert math.degrees(math.atan2(ahead[1], ahead[0])) > 5.0  # what the axes are
    capture = stands.position_ankle_in_world[:2] + (bound + beyond_m) * ahead
    watch = WalkWatch(simulation.robot, simulation.gait)
    watch.update(result.terms, result.balance, simulation.plant.feet(), capture, omega)
    assert (watch.first_cause("pelvis_low", now).name == "missed_capture") == missed


def test_a_fall_after_the_last_step_is_missed_by_the_soles_alone():
    """Standing at the end of a walk, no step is to come: the push takes the capture point out of both soles."""
    simulation = simulation_of({**THREE_STEPS, "reference.steps": 1})
    while simulation.gait.progress.phase != "standing":
        simulation.tick()
    simulation.pushes.append(
        Push(start_s=simulation.time_s + 0.01, duration_s=0.1, impulse_ns=120.0, direction_deg=0.0)
    )
    until_it_falls(simulation)
    assert simulation.fall_first.name == "missed_capture"


def test_from_a_checkpoint_the_same_first_cause_follows():
    simulation = simulation_of(TRIPS)
    for _ in range(1_600):  # it has tripped, and has not fallen
        simulation.tick()
    assert simulation.fallen is None
    kept = simulation.checkpoint()
    first = until_it_falls(simulation).fall_first
    simulation.restore(kept)
    assert simulation.fall_first is None
    assert until_it_falls(simulation).fall_first == first


def test_the_summary_names_it_for_walks_and_for_nothing_else():
    summary = run(load_scenario("walk_flat", FALLS["tipped_sole"]), "two-part").summary
    assert summary["fall_first_cause"] == "tipped_sole"
    assert 0.8 < summary["fall_first_cause_time_s"] < summary["fall_time_s"]
    walks = run(load_scenario("walk_flat", {**THREE_STEPS, "duration_s": 0.1}), "two-part").summary
    assert walks["fall_first_cause"] is walks["fall_first_cause_time_s"] is None
    stands = run(load_scenario("stand_left", {"duration_s": 0.05}), "two-part").summary
    assert not [key for key in stands if key.startswith("fall_first")]


def test_the_help_defines_each_of_them_once_with_the_numbers_in_force():
    section = help_text("command_line").partition("## What ended a walk")[2].partition("\n## ")[0]
    defined = dict(re.findall(r"^\| `(\w+)` \| (.+) \|$", section, re.MULTILINE))
    assert list(defined) == list(walk_cause_texts(load_robot("bip").sizes))
    numbers = {
        "trip": (f"{TOUCH_N:.0f} N", f"{FAR_M * 1e3:.0f} mm"),
        "late_landing": (f"{LATE_S:g} s",),
        "out_of_reach": (f"{math.degrees(STRAIGHT_RAD):.0f} degree",),
        "slip": (f"{SUPPORT_LOST_N:.0f} N", f"{SLID_M * 1e3:.0f} mm"),
        "tipped_sole": (f"{SUPPORT_LOST_N:.0f} N", f"{math.degrees(TIPPED_RAD):.0f} degrees"),
        "missed_capture": (f"{AHEAD_M[1]:g} m ahead", f"{ASIDE_M[1]:g} m aside"),
    }
    assert set(numbers) == set(defined)
    missing = [(name, number) for name, needed in numbers.items() for number in needed if number not in defined[name]]
    assert not missing
    assert f"the last {WINDOW_S:g} s" in section


def test_a_robot_of_another_size_is_told_its_own_numbers():
    """``offset`` weighs a third of Bip, its legs are 0.633 m long and its G is two thirds as high."""
    sizes = load_robot("offset").sizes
    assert f"more than {TOUCH_N * sizes.weight:.0f} N over {1e3 * FAR_M * sizes.leg:.0f} mm" in first_cause_text(
        "trip", sizes
    )
    assert "more than 13 N over 39 mm" in first_cause_text("trip", sizes)
    assert "within 0.122 s after" in first_cause_text("late_landing", sizes)  # 0.15 s sqrt(0.665)
    assert "slid by 23 mm" in first_cause_text("slip", sizes)
