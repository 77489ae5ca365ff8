"""What the summary of a run says of its pushes: J, J_cap from rest by hand, and their ratio; nothing of who moves."""

import json
import math

import pytest

from surefoot.cli.main import main
from surefoot.experiments.runs.push_shares import push_shares
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.task.posture import standing_reference

SHORT = {"duration_s": 0.02}
BACKWARD = {"pushes.1.direction_deg": 180.0, "pushes.1.impulse_ns": 5.0, "pushes.1.link": "pelvis"}


def test_it_is_the_impulse_over_what_the_sole_can_give_on_that_side_from_rest():
    """With the ZMP at the edge a force F moves the capture point by xi' = omega (xi - edge) + F / (m omega)."""
    scenario = load_scenario("push_left", {**SHORT, **BACKWARD, "pushes.1.duration_s": 0.4})
    robot = scenario.robot_description()
    at_rest = standing_reference(robot, scenario.support)
    omega = math.sqrt(robot.gravity / at_rest.position_com[2])
    x, y = (at_rest.position_com - at_rest.position_ankles[0])[:2].tolist()
    heel, _, (toe, half_toe, _), (_, half_heel, _) = robot.feet[0].corners_from_ankle.tolist()
    share = (x - heel[0]) / (toe - heel[0])  # the sole's sides are straight between heel and toe
    edges_m = half_heel + share * (half_toe - half_heel) - y, x - heel[0]
    told = run(scenario, "two-part").summary["pushes"]
    assert [push["link"] for push in told] == ["com", "pelvis"]
    for push, planned, edge_m in zip(told, scenario.pushes, edges_m, strict=True):
        force, grown = push["bound_ns"] / planned.duration_s, math.exp(omega * planned.duration_s)
        reached_m = (grown - 1.0) * (force / (robot.mass_kg * omega**2) - edge_m)
        assert reached_m == pytest.approx(edge_m, rel=1e-9)  # just there as the push ends, and no farther
        assert push["impulse_ns"] == planned.impulse_ns
        assert push["eta"] == pytest.approx(planned.impulse_ns / push["bound_ns"], rel=1e-12)


@pytest.mark.parametrize(("name", "path"), [("walk_flat", "pushes.0.impulse_ns"), ("swing_inward", "pushes.0.link")])
def test_of_who_moves_and_of_who_is_not_pushed_nothing_is_said(name, path):
    assert push_shares(load_scenario(name, {path: {"pushes.0.impulse_ns": 5.0, "pushes.0.link": "com"}[path]})) == []
    assert "pushes" not in run(load_scenario("stand_left", SHORT), "two-part").summary


def test_the_screen_and_the_json_say_the_same(capsys):
    changes = [text for path, value in {**SHORT, **BACKWARD}.items() for text in ("--set", f"{path}={value}")]
    main(["run", "push_left", "--set", "pushes.0.start_s=0.005", *changes, "--json"])
    left, back = json.loads(capsys.readouterr().out)["pushes"]
    main(["run", "push_left", "--set", "pushes.0.start_s=0.005", *changes])
    said = " ".join(capsys.readouterr().out.split())
    assert f"at 0.005 s: eta = J / J_cap = 20 / {left['bound_ns']:.0f} N s = {left['eta']:.3f} push" in said
    assert f"5 / {back['bound_ns']:.0f} N s = {back['eta']:.3f}; the push is on the pelvis" in said
    assert "it did not come" in said.partition("the push is on the pelvis")[2]
