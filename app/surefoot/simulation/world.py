"""The MuJoCo model of robot, ground and stones. Only this file builds it."""

import logging

import mujoco

from surefoot.geometry.rotations import quaternion_wxyz
from surefoot.robot.description import RobotDescription
from surefoot.robot.sensing import ImuMount
from surefoot.simulation.ground import GroundPose
from surefoot.simulation.imperfections import PERFECT_PLANT, Imperfections
from surefoot.simulation.model_error import perturb
from surefoot.simulation.motors import add_friction
from surefoot.simulation.physics import CONTACT_SOLREF, IMPEDANCE_RATIO, TIMESTEP_S, PhysicsSettings
from surefoot.simulation.stone_pool import add_stone_pool
from surefoot.simulation.terrain import LEVEL, Terrain

# MuJoCo would print its warnings and write a log file into the current folder
mujoco.set_mju_user_warning(logging.getLogger("surefoot.mujoco").info)

FLOOR, TERRAIN, IMU = "floor", "terrain", "imu"
_ROOT_M = 0.05  # a block reaches so far below the plane, so that none is ever thin
_GROUND_BITS = {"contype": 2, "conaffinity": 1}  # touches the robot (contype 1, conaffinity 2) and nothing else


def build_world(
    robot: RobotDescription,
    physics: PhysicsSettings,
    terrain: Terrain = LEVEL,
    imperfections: Imperfections = PERFECT_PLANT,
) -> mujoco.MjModel:
    """Robot on level ground with a pool of stones: implicitfast, 1 ms, elliptic cone, impratio 10.

    With an IMU the model has a site and an accelerometer of the name ``IMU``.
    """
    if robot.mjcf_xml is None:
        spec = mujoco.MjSpec.from_file(str(robot.mjcf_path))
    else:
        spec = mujoco.MjSpec.from_string(robot.mjcf_xml)
    if imperfections.model_error.any:
        perturb(spec, robot, imperfections.model_error)
    spec.worldbody.add_geom(
        name=FLOOR,
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[0.0, 0.0, 0.05],
        pos=[0.0, 0.0, -terrain.depth_m],
        rgba=[0.82, 0.84, 0.86, 1.0],
        **_GROUND_BITS,
    )
    add_stone_pool(spec, _GROUND_BITS)
    _add_terrain(spec, terrain)
    if imperfections.imu is not None:
        _add_imu(spec, imperfections.imu)
    spec.option.timestep = TIMESTEP_S
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = IMPEDANCE_RATIO
    # on a NaN MuJoCo would quietly start over, which looks like survival; we stop and call it a fall
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    spec.option.gravity = [0.0, 0.0, -robot.gravity]
    model = spec.compile()
    model.geom_solref[:] = CONTACT_SOLREF
    add_friction(model, imperfections.motors, robot)
    apply_physics(model, physics, friction_scale=imperfections.model_error.friction_scale)
    return model


def turn_floor(model: mujoco.MjModel, data: mujoco.MjData, ground: GroundPose, terrain: Terrain) -> None:
    """Write the ground's pose into a compiled model."""
    floor = model.geom(FLOOR).id
    model.geom_sameframe[floor] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE  # else MuJoCo takes the world's own axes
    model.geom_pos[floor] = ground.pivot - terrain.depth_m * ground.up
    mujoco.mju_mat2Quat(model.geom_quat[floor], ground.rotation.ravel())
    if terrain.blocks:
        _turn_terrain(model, data, ground)


def apply_physics(
    model: mujoco.MjModel, physics: PhysicsSettings, *, mass_scale_before: float = 1.0, friction_scale: float = 1.0
) -> None:
    """Write friction, mass scale and torque limits into a compiled model."""
    model.geom_friction[:, 0] = physics.friction * friction_scale
    model.actuator_ctrllimited[:] = physics.torque_limits
    ratio = physics.mass_scale / mass_scale_before
    if ratio != 1.0:
        model.body_mass *= ratio
        model.body_inertia *= ratio
        mujoco.mj_setConst(model, mujoco.MjData(model))


def _add_terrain(spec: mujoco.MjSpec, terrain: Terrain) -> None:
    """Add the blocks to a model before it is compiled; as one body, so that they can be turned with the ground."""
    if not terrain.blocks:
        return
    body = spec.worldbody.add_body(name=TERRAIN, mocap=True)
    bottom = -terrain.depth_m - _ROOT_M
    for block in terrain.blocks:
        half_height = 0.5 * (block.top_m - bottom)
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[0.5 * block.length_m, 0.5 * block.width_m, half_height],
            pos=[block.x_m, block.y_m, bottom + half_height],
            rgba=[0.62, 0.60, 0.56, 1.0],
            **_GROUND_BITS,
        )


def _add_imu(spec: mujoco.MjSpec, imu: ImuMount) -> None:
    spec.body(imu.body).add_site(name=IMU, pos=imu.position_in_body, quat=quaternion_wxyz(imu.rotation_in_body))
    spec.add_sensor(name=IMU, type=mujoco.mjtSensor.mjSENS_ACCELEROMETER, objtype=mujoco.mjtObj.mjOBJ_SITE, objname=IMU)


def _turn_terrain(model: mujoco.MjModel, data: mujoco.MjData, ground: GroundPose) -> None:
    """Turn the blocks to where the ground lies."""
    mocap = int(model.body(TERRAIN).mocapid[0])
    data.mocap_pos[mocap] = ground.pivot - ground.rotation.dot(ground.pivot)
    mujoco.mju_mat2Quat(data.mocap_quat[mocap], ground.rotation.ravel())
