"""The MJCF file of a robot as MuJoCo compiles it: includes, defaults, ``<frame>`` and ``<replicate>`` are resolved."""

from pathlib import Path

import mujoco
import numpy as np

from surefoot.errors import InvalidInput

_STANDING_KEYS = ("home", "stand", "standing")


def read_mjcf(path: Path) -> tuple[mujoco.MjModel, frozenset[str]]:
    """Compile an MJCF file; and the names of its meshes that ``refpos`` or ``refquat`` moves within their files.

    Raises:
        InvalidInput: MuJoCo does not read it; in its own words.
    """
    try:
        spec = mujoco.MjSpec.from_file(str(path.resolve()))
        return spec.compile(), moved_meshes(spec)
    except (ValueError, mujoco.FatalError) as error:
        raise InvalidInput(
            "robot", str(path), f"is no MJCF that MuJoCo reads: {' '.join(str(error).split())}"
        ) from None


def moved_meshes(spec: mujoco.MjSpec) -> frozenset[str]:
    """Names of the meshes that do not lie as in their files: a compiled model no longer says so."""
    unmoved = np.array((1.0, 0.0, 0.0, 0.0))
    return frozenset(
        mesh.name or Path(mesh.file).stem
        for mesh in spec.meshes
        if np.any(mesh.refpos) or not np.array_equal(mesh.refquat, unmoved)
    )


def keyframe_names(model: mujoco.MjModel) -> list[str]:
    """Names of the keyframes that have one."""
    return [name for key in range(model.nkey) if (name := model.key(key).name)]


def choose_keyframe(model: mujoco.MjModel, asked: str | None) -> str | None:
    """Name of the keyframe to stand in: the one asked for, else home or stand, else the only one there is.

    Raises:
        InvalidInput: the one asked for is not there.
    """
    names = keyframe_names(model)
    if asked is not None:
        if asked not in names:
            raise InvalidInput("keyframe", asked, "the file has no such keyframe", names)
        return asked
    return next((name for name in _STANDING_KEYS if name in names), names[0] if len(names) == 1 else None)


def keyframe_qpos(model: mujoco.MjModel, keyframe: str | None) -> np.ndarray:
    """Configuration (nq,) of a keyframe, in MuJoCo's layout; the one in which the bodies are written without one."""
    return model.qpos0.copy() if keyframe is None else model.key(keyframe).qpos.copy()


def joint_type(model: mujoco.MjModel, joint: int) -> str:
    """``free``, ``ball``, ``slide`` or ``hinge``."""
    return mujoco.mjtJoint(model.jnt_type[joint]).name.removeprefix("mjJNT_").lower()


def name_of(model: mujoco.MjModel, kind: mujoco.mjtObj, index: int) -> str:
    """Name of an object; its kind and number where it has none."""
    return mujoco.mj_id2name(model, kind, index) or f"{kind.name.removeprefix('mjOBJ_').lower()} {index}"
