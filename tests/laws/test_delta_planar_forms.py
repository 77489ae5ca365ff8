"""Law of (6), (7): the planar forms of delta_P, told apart from the full one (5) by examples."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.dynamics.links import evaluate_links
from surefoot.momentum.delta import FORMS, delta_from_links
from surefoot.robot.description import RobotState

ROUNDING = {"rtol": 0, "atol": 1e-9}  # sums over 16 links of terms up to 1e3 N m
# The paper's axes: x forward, y up, z to the right.
TO_PAPER = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
SAGITTAL_JOINTS = ("hip_sagittal", "knee", "ankle_sagittal", "trunk_sagittal")


@pytest.fixture(params=range(8))
def moving(request, robot, random_state):
    rng = np.random.default_rng(2000 + request.param)
    return evaluate_links(robot, random_state(request.param), rng.normal(scale=5.0, size=21)), rng.normal(size=3)


def planar_motion(robot, dynamics, of_plane: tuple[str, ...], base: int, seed: int = 3):
    """A motion in which every link turns about one and the same axis: joints of a plane, and the pelvis about it."""
    rng = np.random.default_rng(seed)
    dofs = [j.dof for j in robot.joints if any(part in j.name for part in of_plane)] + [base]
    step, v, a = np.zeros(21), np.zeros(21), np.zeros(21)
    step[dofs], v[dofs], a[dofs] = (rng.normal(scale=s, size=len(dofs)) for s in (0.2, 1.0, 5.0))
    q = dynamics.integrate(dynamics.neutral(np.array((0.3, -0.2, 0.9))), step)
    return evaluate_links(robot, RobotState(q, v), a)


def test_diagonal_form_is_the_full_one_for_motion_in_the_sagittal_plane(robot, dynamics):
    """Every link then turns about the world's y, however it is pitched: I_yy w_y' is exact under delta_y."""
    links = planar_motion(robot, dynamics, SAGITTAL_JOINTS, base=4)
    P = np.array((0.1, 0.2, 0.0))
    full, diagonal = (delta_from_links(P, links, form) for form in ("full", "diagonal"))
    assert abs(full[1]) > 10.0
    assert diagonal[1] == pytest.approx(full[1], abs=1e-9)


def test_diagonal_form_is_the_full_one_for_motion_in_the_frontal_plane(robot, dynamics):
    links = planar_motion(robot, dynamics, ("frontal",), base=3)
    P = np.array((0.1, 0.2, 0.0))
    full, diagonal = (delta_from_links(P, links, form) for form in ("full", "diagonal"))
    assert abs(full[0]) > 10.0
    assert diagonal[0] == pytest.approx(full[0], abs=1e-9)


def test_a_tilted_link_tells_diagonal_from_full(robot, dynamics):
    """Turn the same motion's world by a roll of 0.5 rad: the full form follows (5), the link-axes form does not."""
    links = planar_motion(robot, dynamics, SAGITTAL_JOINTS, base=4)
    c, s = np.cos(0.5), np.sin(0.5)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    tilted = replace(
        links,
        position_com=links.position_com @ turn.T,
        acceleration_com=links.acceleration_com @ turn.T,
        rotation_link_to_world=turn @ links.rotation_link_to_world,
    )
    P = np.array((0.1, 0.2, 0.0))
    full = delta_from_links(P, links, "full")
    assert_allclose(delta_from_links(turn @ P, tilted, "full"), turn @ full, **ROUNDING)
    assert abs(delta_from_links(turn @ P, tilted, "diagonal")[1] - (turn @ full)[1]) > 1.0


@pytest.mark.parametrize(("form", "under_x", "under_z"), [("printed", 2, 0), ("diagonal", 0, 2)])
def test_planar_forms_are_the_papers_in_the_papers_axes(moving, form, under_x, under_z):
    """(6), (7) written down in the paper's axes: as printed I_z w_z' stands under delta_x and I_x w_x' under delta_z,
    and the diagonal form puts each back under its own component."""
    links, P = moving
    m = links.mass_kg
    x, y, z = TO_PAPER @ (links.position_com - P).T
    ax, ay, az = TO_PAPER @ links.acceleration_com.T
    inertia = TO_PAPER @ links.inertia_at_com @ TO_PAPER.T
    w_dot = TO_PAPER @ links.omega_dot.T
    delta_x = (inertia[:, under_x, under_x] * w_dot[under_x] + m * (y * az - z * ay)).sum()
    delta_z = (inertia[:, under_z, under_z] * w_dot[under_z] + m * (x * ay - y * ax)).sum()
    found = TO_PAPER @ delta_from_links(P, links, form)
    assert_allclose(found[[0, 2]], [delta_x, delta_z], **ROUNDING)


def test_the_three_forms_differ_in_general_and_share_the_vertical_component(moving):
    links, P = moving
    full, diagonal, printed = (delta_from_links(P, links, form) for form in FORMS)
    for one, other in ((full, diagonal), (full, printed), (diagonal, printed)):
        assert np.abs(one - other)[:2].min() > 0.01
    assert full[2] == diagonal[2] == printed[2]


def test_the_forms_agree_where_no_link_turns(robot, dynamics):
    """In pure translation the rotation terms vanish: what differs between the forms is nothing but them."""
    acceleration = np.r_[1.0, -2.0, 3.0, np.zeros(18)]
    state = RobotState(dynamics.neutral(np.array((0.0, 0.0, 0.9))), np.r_[0.3, 0.2, 0.1, np.zeros(18)])
    links = evaluate_links(robot, state, acceleration)
    G = (links.mass_kg @ links.position_com) / links.mass_kg.sum()
    P = np.array((0.05, 0.11, 0.0))
    by_hand = np.cross(G - P, links.mass_kg.sum() * acceleration[:3])
    for form in FORMS:
        assert_allclose(delta_from_links(P, links, form), by_hand, **ROUNDING)
