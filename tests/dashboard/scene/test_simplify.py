"""Meshes with fewer faces keep shape, size and side."""

import numpy as np
import pytest
import trimesh

from surefoot.dashboard.scene.simplify import simplified

MOST = 800


@pytest.fixture(scope="module")
def ball():
    return trimesh.creation.icosphere(subdivisions=5, radius=0.1)


def test_a_ball_keeps_its_surface_and_its_outside(ball):
    vertices, faces = simplified(np.asarray(ball.vertices), np.asarray(ball.faces), MOST)
    assert 0.5 * MOST < len(faces) <= MOST < len(ball.faces)
    assert faces.max() == len(vertices) - 1
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 0.1, atol=0.003)
    one, two, three = (vertices[faces[:, i]] for i in range(3))
    outward = (np.cross(two - one, three - one) * (one + two + three)).sum(axis=1)
    assert (outward > 0.0).mean() > 0.99
    assert trimesh.Trimesh(vertices, faces).volume == pytest.approx(ball.volume, rel=0.03)


def test_corners_of_a_box_stay_sharp():
    box = trimesh.creation.box((0.3, 0.2, 0.1))
    fine = box.subdivide_to_size(0.01)
    vertices, faces = simplified(np.asarray(fine.vertices), np.asarray(fine.faces), MOST)
    assert len(faces) <= MOST < len(fine.faces)
    nearest = np.linalg.norm(box.vertices[:, None] - vertices[None], axis=2).min(axis=1)
    assert nearest.max() < 0.001
    np.testing.assert_allclose(np.ptp(vertices, axis=0), (0.3, 0.2, 0.1), atol=0.001)


def test_a_mesh_that_is_small_enough_is_left_alone(ball):
    vertices, faces = np.asarray(ball.vertices), np.asarray(ball.faces)
    same = simplified(vertices, faces, len(faces))
    assert same[0] is vertices
    assert same[1] is faces


def test_something_is_left_of_splinters_and_of_what_may_have_hardly_a_face(ball):
    vertices = np.array(((0.0, 0.0, 0.0), (1e-4, 0.0, 0.0), (0.0, 1e-4, 0.0), (1.0, 1.0, 1.0)))
    faces = np.repeat(((0, 1, 2),), 50, axis=0)
    assert len(simplified(vertices, faces, 10)[1]) == 50
    assert 0 < len(simplified(np.asarray(ball.vertices), np.asarray(ball.faces), 1)[1]) < 50
