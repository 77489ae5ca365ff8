"""The MuJoCo model of robot, ground and stones. Only this file builds it."""

import logging

import mujoco

from surefoot.robot.description import RobotDescription
from surefoot.simulation.ground import GroundPose
from surefoot.simulation.physics import CONTACT_SOLREF, IMPEDANCE_RATIO, TIMESTEP_S, PhysicsSettings
from surefoot.simulation.stone_pool import add_stone_pool
from surefoot.simulation.terrain import LEVEL, Terrain, add_terrain, turn_terrain

# MuJoCo would print its warnings and write a log file into the current folder
mujoco.set_mju_user_warning(logging.getLogger("surefoot.mujoco").info)

FLOOR = "floor"
_GROUND_BITS = {"contype": 2, "conaffinity": 1}  # touches the robot (contype 1, conaffinity 2) and nothing else


def build_world(robot: RobotDescription, physics: PhysicsSettings, terrain: Terrain = LEVEL) -> mujoco.MjModel:
    """Robot on level ground with a pool of stones: implicitfast, 1 ms, elliptic cone, impratio 10."""
    spec = mujoco.MjSpec.from_file(str(robot.mjcf_path))
    spec.worldbody.add_geom(
        name=FLOOR,
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[0.0, 0.0, 0.05],
        pos=[0.0, 0.0, -terrain.depth_m],
        rgba=[0.82, 0.84, 0.86, 1.0],
        **_GROUND_BITS,
    )
    add_stone_pool(spec, _GROUND_BITS)
    add_terrain(spec, terrain, _GROUND_BITS)
    spec.option.timestep = TIMESTEP_S
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = IMPEDANCE_RATIO
    # on a NaN MuJoCo would quietly start over, which looks like survival; we stop and call it a fall
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    spec.option.gravity = [0.0, 0.0, -robot.gravity]
    model = spec.compile()
    model.geom_solref[:] = CONTACT_SOLREF
    apply_physics(model, physics)
    return model


def turn_floor(model: mujoco.MjModel, data: mujoco.MjData, ground: GroundPose, terrain: Terrain) -> None:
    """Write the ground's pose into a compiled model."""
    floor = model.geom(FLOOR).id
    model.geom_sameframe[floor] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE  # else MuJoCo takes the world's own axes
    model.geom_pos[floor] = ground.pivot - terrain.depth_m * ground.up
    mujoco.mju_mat2Quat(model.geom_quat[floor], ground.rotation.ravel())
    if terrain.blocks:
        turn_terrain(model, data, ground)


def apply_physics(model: mujoco.MjModel, physics: PhysicsSettings, *, mass_scale_before: float = 1.0) -> None:
    """Write friction, mass scale and torque limits into a compiled model."""
    model.geom_friction[:, 0] = physics.friction
    model.actuator_ctrllimited[:] = physics.torque_limits
    ratio = physics.mass_scale / mass_scale_before
    if ratio != 1.0:
        model.body_mass *= ratio
        model.body_inertia *= ratio
        mujoco.mj_setConst(model, mujoco.MjData(model))
