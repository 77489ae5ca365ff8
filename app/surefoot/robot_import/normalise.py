"""An MJCF made plain in memory, so that MuJoCo and Pinocchio read the same robot from it."""

from collections.abc import Collection, Mapping, Sequence
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco
import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot_import.mjcf_source import joint_type, name_of
from surefoot.robot_import.mjcf_writer import empty_mjcf, numbers, write_geom, write_hinge, write_inertial, write_mesh
from surefoot.robot_import.problem import RefusedError

_ROOT_JOINT = "root"


@record
class PlainMjcf:
    """A robot alone: a free base, hinges, no defaults, no world.

    Attributes:
        root: the MJCF.
        changed: what is other than in the file, one line each.
        dropped: what was left out, one line each.
    """

    root: Element
    changed: list[str]
    dropped: list[str]

    def text(self) -> str:
        """The MJCF as text."""
        return tostring(self.root, encoding="unicode")


def robot_bodies(model: mujoco.MjModel) -> list[int]:
    """The bodies of the robot: the tree below the world with most hinges, its root first.

    Raises:
        RefusedError: no body hangs on a hinge.
    """
    hinges = {root: 0 for root in set(model.body_rootid.tolist()) if root > 0}
    for joint in range(model.njnt):
        if joint_type(model, joint) == "hinge":
            hinges[int(model.body_rootid[model.jnt_bodyid[joint]])] += 1
    root = max(sorted(hinges), key=lambda body: hinges[body], default=0)
    if not root or not hinges[root]:
        raise RefusedError("joints", "the file has no hinge", "give the MJCF of a robot: bodies joined by hinges")
    return [body for body in range(1, model.nbody) if int(model.body_rootid[body]) == root]


def plain_mjcf(
    model: mujoco.MjModel, qpos: np.ndarray, frozen: Collection[str], moved_meshes: Collection[str] = ()
) -> PlainMjcf:
    """The robot of a compiled model.

    Args:
        model: as its owner wrote it.
        qpos: its configuration (nq,); joints that are taken out are held at theirs.
        frozen: names of the joints that are taken out.
        moved_meshes: names of the meshes that do not lie as in their files.

    Raises:
        InvalidInput: a frozen joint is not there.
        RefusedError: there is no robot in it.
    """
    names = [model.joint(joint).name for joint in range(model.njnt)]
    for name in frozen:
        if name not in names:
            raise InvalidInput("frozen", name, "the model has no such joint", names)
    bodies = robot_bodies(model)
    plain = PlainMjcf(empty_mjcf(model.body(bodies[0]).name or "robot"), [], [])
    held = _held(model, qpos, frozen)
    touching = _touching(model)
    meshes = {
        mesh: write_mesh(plain.root, model, mesh, by_file=model.mesh(mesh).name not in moved_meshes)
        for mesh in sorted(
            {int(model.geom_dataid[geom]) for geom in range(model.ngeom) if _is_mesh(model, geom, bodies)}
        )
    }
    world = plain.root.find("worldbody")
    assert world is not None
    elements: dict[int, Element] = {0: world}
    for body in bodies:
        element = SubElement(elements[int(model.body_parentid[body])] if body != bodies[0] else world, "body")
        element.set("name", model.body(body).name or f"body_{body}")
        elements[body] = element
        _write_body(plain, element, model, body, held, frozen)
        first = int(model.body_geomadr[body])
        for geom in range(first, first + int(model.body_geomnum[body])):
            if not write_geom(plain.root, element, model, geom, meshes, touching=geom in touching):
                plain.dropped.append(
                    f"{name_of(model, mujoco.mjtObj.mjOBJ_GEOM, geom)}: a shape that is not known here"
                )
    if several := _several_hinges(plain.root):
        plain.changed.append(
            f"bodies with several hinges, for Pinocchio a chain of massless links with one each: {', '.join(several)}"
        )
    endless = [name for name in _kept_hinges(model, bodies, frozen) if not model.jnt_limited[model.joint(name).id]]
    if endless:
        plain.changed.append(f"joints without a range, -180 to 180 deg taken: {', '.join(endless)}")
    if frozen:
        plain.changed.append(f"joints taken out, held at the posture's angle: {', '.join(frozen)}")
    _tell_left_out(plain, model, bodies)
    return plain


def _write_body(
    plain: PlainMjcf,
    element: Element,
    model: mujoco.MjModel,
    body: int,
    held: mujoco.MjData,
    frozen: Collection[str],
) -> None:
    first = int(model.body_jntadr[body])
    joints = list(range(first, first + int(model.body_jntnum[body])))
    moved = any(model.joint(joint).name in frozen for joint in joints)
    position, quaternion = _relative_pose(model, held, body) if moved else (model.body_pos[body], model.body_quat[body])
    element.set("pos", numbers(position))
    element.set("quat", numbers(quaternion))
    write_inertial(element, model, body)
    kinds = [joint_type(model, joint) for joint in joints]
    if body == model.body_rootid[body]:
        SubElement(element, "freejoint", name=_ROOT_JOINT)
        if "free" not in kinds:
            names = ", ".join(name_of(model, mujoco.mjtObj.mjOBJ_JOINT, joint) for joint in joints)
            held_by = f"hung on the world by {names}" if names else "was fixed to the world"
            plain.changed.append(f"the base {element.get('name')} {held_by}: given a free joint")
        return
    rotation = held.xmat[body].reshape(3, 3)
    for joint, kind in zip(joints, kinds, strict=True):
        name = model.joint(joint).name
        if kind != "hinge" or name in frozen:
            continue
        anchor, axis = model.jnt_pos[joint], model.jnt_axis[joint]
        if moved:
            anchor, axis = rotation.T @ (held.xanchor[joint] - held.xpos[body]), rotation.T @ held.xaxis[joint]
        write_hinge(element, model, joint, anchor, axis)
        if ref := float(model.qpos0[model.jnt_qposadr[joint]]):
            plain.changed.append(f"{name} had ref {ref:g}: its angle counts from 0 where the bodies are drawn")


def _several_hinges(root: Element) -> list[str]:
    """Names of the bodies with more than one hinge, and how many it has."""
    counts = [(body.get("name"), len(body.findall("joint"))) for body in root.iter("body")]
    return [f"{name} ({count})" for name, count in counts if count > 1]


def _kept_hinges(model: mujoco.MjModel, bodies: Sequence[int], frozen: Collection[str]) -> list[str]:
    """Their names; ``bodies``: the base first, whose own joints are replaced by a free one."""
    names = [(joint, model.joint(joint).name) for joint in range(model.njnt)]
    return [
        name
        for joint, name in names
        if int(model.jnt_bodyid[joint]) in bodies[1:] and joint_type(model, joint) == "hinge" and name not in frozen
    ]


def _held(model: mujoco.MjModel, qpos: np.ndarray, frozen: Collection[str]) -> mujoco.MjData:
    """Every body as drawn, but with the frozen joints at their angle."""
    data = mujoco.MjData(model)
    for name in frozen:
        first = int(model.joint(name).qposadr[0])
        count = len(model.joint(name).qpos0)
        data.qpos[first : first + count] = qpos[first : first + count]
    mujoco.mj_kinematics(model, data)
    return data


def _relative_pose(model: mujoco.MjModel, data: mujoco.MjData, body: int) -> tuple[np.ndarray, np.ndarray]:
    parent = int(model.body_parentid[body])
    back, quaternion, position = np.zeros(4), np.zeros(4), np.zeros(3)
    mujoco.mju_negQuat(back, data.xquat[parent])
    mujoco.mju_mulQuat(quaternion, back, data.xquat[body])
    mujoco.mju_rotVecQuat(position, data.xpos[body] - data.xpos[parent], back)
    return position, quaternion


def _touching(model: mujoco.MjModel) -> set[int]:
    """Geoms that can touch something: by their bits, or because a pair names them."""
    by_bits = {geom for geom in range(model.ngeom) if model.geom_contype[geom] or model.geom_conaffinity[geom]}
    return by_bits | set(model.pair_geom1.tolist()) | set(model.pair_geom2.tolist())


def _is_mesh(model: mujoco.MjModel, geom: int, bodies: Collection[int]) -> bool:
    return model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH and int(model.geom_bodyid[geom]) in bodies


def _tell_left_out(plain: PlainMjcf, model: mujoco.MjModel, bodies: Collection[int]) -> None:
    """What a file has beside the robot's bodies, joints and shapes; loops and drives are looked at elsewhere."""
    world_geoms = sum(int(model.geom_bodyid[geom]) not in bodies for geom in range(model.ngeom))
    nonlinear = sum(bool(model.dof_dampingpoly[dof].any()) for dof in range(model.nv))
    gravcomp = sum(model.body_gravcomp[body] != 0.0 for body in bodies)
    counts: Mapping[str, int] = {
        "geoms of the world and of other bodies": world_geoms,
        "bodies beside the robot": model.nbody - 1 - len(bodies),
        "sites": model.nsite,
        "cameras": model.ncam,
        "lights": model.nlight,
        "sensors": model.nsensor,
        "contact pairs (their geoms touch the ground instead)": model.npair,
        "contact exclusions": model.nexclude,
        "joints whose damping grows with their rate (its constant part is kept)": nonlinear,
        "bodies with gravity compensation (it is left out)": int(gravcomp),
    }
    plain.dropped.extend(f"{what}: {count}" for what, count in counts.items() if count)
