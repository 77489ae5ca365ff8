"""The MJCF that is spelled out is the same robot: M and places against MuJoCo's own reading of the file."""

import mujoco
import numpy as np
import pytest

from surefoot.robot_import.mjcf_source import read_mjcf
from surefoot.robot_import.normalise import plain_mjcf
from tests.support.small_biped import ARM, biped

MESH = """<asset><mesh name="wedge" scale="0.5 1 2" vertex="0 0 0  0.2 0 0  0 0.1 0  0 0 0.1  0.2 0.1 0.05"/></asset>"""
WEDGE = """<body name="box" pos="0 0.1 0.1" quat="0.9 0.1 0.2 0.3">
  <geom type="mesh" mesh="wedge" pos="0.1 0 0" euler="0.3 0.2 0.1"/></body>"""


def mass_matrix(model: mujoco.MjModel, qpos: np.ndarray) -> tuple[np.ndarray, mujoco.MjData]:
    data = mujoco.MjData(model)
    data.qpos[:] = qpos
    mujoco.mj_forward(model, data)
    matrix = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, matrix)
    return matrix, data


def random_qpos(model: mujoco.MjModel, seed: int) -> np.ndarray:
    qpos = np.random.default_rng(seed).uniform(-0.5, 0.5, model.nq)
    qpos[3:7] /= np.linalg.norm(qpos[3:7])
    return qpos


def test_the_last_digit_is_kept():
    original = mujoco.MjModel.from_xml_string(biped(joint='range="-1.5 1.5" armature="0.0123456789"'))
    plain = mujoco.MjModel.from_xml_string(plain_mjcf(original, original.qpos0, ()).text())
    qpos = random_qpos(original, 1)
    one, other = mass_matrix(original, qpos)[0], mass_matrix(plain, qpos)[0]
    assert np.array_equal(one, other)


@pytest.mark.parametrize(("from_file", "reference"), [(False, ""), (True, ""), (True, 'refpos="0.01 0.02 0.03"')])
def test_a_mesh_stays_where_it_is(tmp_path, from_file, reference):
    """Its vertices in world, though MuJoCo moves every mesh to its own centre."""
    mesh = MESH
    if from_file:
        points = np.array(((0, 0, 0), (0.2, 0, 0), (0, 0.1, 0), (0, 0, 0.1)), dtype=float)
        faces = ((1, 3, 2), (1, 2, 4), (1, 4, 3), (2, 3, 4))
        lines = [f"v {x} {y} {z}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in faces]
        (tmp_path / "wedge.obj").write_text("\n".join(lines) + "\n")
        mesh = f'<asset><mesh file="{tmp_path / "wedge.obj"}" scale="0.5 1 2" {reference}/></asset>'
    (tmp_path / "robot.xml").write_text(biped(upper=ARM + WEDGE, extra=mesh))
    original, moved = read_mjcf(tmp_path / "robot.xml")
    plain = mujoco.MjModel.from_xml_string(plain_mjcf(original, original.qpos0, (), moved).text())
    places = []
    for model in (original, plain):
        data = mass_matrix(model, random_qpos(original, 2))[1]
        geom = next(g for g in range(model.ngeom) if model.geom_type[g] == mujoco.mjtGeom.mjGEOM_MESH)
        first = int(model.mesh_vertadr[0])
        vertices = model.mesh_vert[first : first + int(model.mesh_vertnum[0])]
        places.append(data.geom_xpos[geom] + vertices @ data.geom_xmat[geom].reshape(3, 3).T)
    apart = np.linalg.norm(places[0][:, None] - places[1][None], axis=2).min(axis=1)
    assert apart.max() < 1e-6


def test_a_joint_taken_out_leaves_the_rest_of_m():
    """M without the frozen joints' rows is M of the robot without them, at their angle."""
    original = mujoco.MjModel.from_xml_string(biped())
    qpos = random_qpos(original, 3)
    frozen = ["waist", "left_ankle_roll"]
    plain = mujoco.MjModel.from_xml_string(plain_mjcf(original, qpos, frozen).text())
    taken = {int(original.joint(name).qposadr[0]) for name in frozen}
    kept = [index for index in range(original.nq) if index not in taken]
    dofs = [dof for dof in range(original.nv) if dof not in {int(original.joint(name).dofadr[0]) for name in frozen}]
    matrix, _ = mass_matrix(original, qpos)
    assert np.allclose(mass_matrix(plain, qpos[kept])[0], matrix[np.ix_(dofs, dofs)], atol=1e-13)


def test_an_angle_counts_from_the_drawn_pose_whatever_ref_says():
    original = mujoco.MjModel.from_xml_string(biped(joint='range="-1.0 1.5" ref="0.2"'))
    mjcf = plain_mjcf(original, original.qpos0, ())
    plain = mujoco.MjModel.from_xml_string(mjcf.text())
    assert plain.joint("left_knee").range == pytest.approx((-1.2, 1.3))
    qpos = random_qpos(original, 4)
    shifted = qpos - np.concatenate((np.zeros(7), original.qpos0[7:]))
    assert np.allclose(mass_matrix(original, qpos)[0], mass_matrix(plain, shifted)[0], atol=1e-13)
