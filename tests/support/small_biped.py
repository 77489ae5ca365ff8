"""A small made-up biped as MJCF text, whose parts a test can exchange for what foreign files have.

Two legs (hip yaw, roll, pitch; knee; ankle pitch, roll), a waist and one arm joint; 19.8 kg; all frames parallel to the
world when every joint is 0.
"""

from collections.abc import Sequence
from pathlib import Path

LEG = (
    # joint, axis, offset of its body in the parent, mass of its link
    ("hip_yaw", "0 0 1", "0 {y} -0.05", 0.5),
    ("hip_roll", "1 0 0", "0 0 -0.02", 0.5),
    ("hip_pitch", "0 1 0", "0 0 -0.02", 2.0),
    ("knee", "0 1 0", "0 0 -0.25", 1.5),
    ("ankle_pitch", "0 1 0", "0 0 -0.25", 0.2),
    ("ankle_roll", "1 0 0", "0 0 -0.012", 0.7),
)
BOX_SOLE = '<geom type="box" size="0.09 0.035 0.01" pos="0.03 0 -0.04" group="3"/>'
SPHERE_SOLE = "".join(
    f'<geom type="sphere" size="0.005" pos="{x} {y} -0.045" group="3"/>' for x in (-0.06, 0.12) for y in (-0.035, 0.035)
)
ARM = """
<body name="arm" pos="0 0.1 0.2">
  <inertial pos="0.2 0 0" mass="0.4" diaginertia="0.001 0.001 0.001"/>
  <joint name="shoulder" axis="0 1 0" range="-2 2"/>
</body>"""


def biped(
    *,
    leg: Sequence[tuple[str, str, str, float]] = LEG,
    sole: str = BOX_SOLE,
    upper: str = ARM,
    after_foot: str = "",
    extra: str = "",
    motor: str = '<motor name="{joint}" joint="{joint}" ctrlrange="-60 60"/>',
    joint: str = 'range="-1.5 1.5" armature="0.01"',
    free: str = '<freejoint name="root"/>',
) -> str:
    """MJCF text.

    Args:
        leg: joint, axis, offset and mass of each link, from the hip down.
        sole: shapes of a foot.
        upper: bodies on the trunk.
        after_foot: bodies and sites on each foot.
        extra: elements beside the world, such as ``<equality>``.
        motor: drive of each joint; empty: none has one.
        joint: attributes of each leg joint.
        free: what frees the base.
    """
    joints = [f"{side}_{name}" for side in ("left", "right") for name, *_ in leg] + ["waist"]
    joints += ["shoulder"] if 'name="shoulder"' in upper else []
    drives = "\n".join(motor.format(joint=name) for name in joints) if motor else ""
    legs = "\n".join(_leg(side, y, leg, sole, after_foot, joint) for side, y in (("left", 0.08), ("right", -0.08)))
    return f"""
<mujoco model="small">
  <compiler angle="radian"/>
  <worldbody>
    <body name="pelvis" pos="0 0 0.647">
      {free}
      <inertial pos="0 0 0" mass="3" diaginertia="0.01 0.01 0.01"/>
      {legs}
      <body name="trunk" pos="0 0 0.05">
        <inertial pos="0 0 0.15" mass="5.6" diaginertia="0.05 0.05 0.02"/>
        <joint name="waist" axis="0 0 1" range="-1 1"/>
        <geom type="box" size="0.05 0.1 0.15" pos="0 0 0.15" group="2"/>
        {upper}
      </body>
    </body>
  </worldbody>
  <actuator>{drives}</actuator>
  {extra}
</mujoco>"""


def _leg(
    side: str, y: float, leg: Sequence[tuple[str, str, str, float]], sole: str, after_foot: str, joint: str
) -> str:
    opened = ""
    for name, axis, offset, mass in leg:
        opened += f"""
      <body name="{side}_{name}_link" pos="{offset.format(y=y)}">
        <inertial pos="0 0 -0.02" mass="{mass}" diaginertia="0.004 0.003 0.002"/>
        <joint name="{side}_{name}" axis="{axis}" {joint}/>"""
    return opened + sole + after_foot.format(side=side) + "</body>" * len(leg)


def bent(mjcf: str) -> str:
    """A robot.toml that stands it with bent knees; ``mjcf``: name of its file."""
    angles = (("hip_pitch", -0.3), ("knee", 0.6), ("ankle_pitch", -0.3))
    lines = [f"{side}_{joint} = {angle}" for side in ("left", "right") for joint, angle in angles]
    return "\n".join((f'mjcf = "{mjcf}"', "[posture]", *lines, ""))


def write_small_robot(folder: Path) -> None:
    """Put ``small/small.xml`` and ``small/robot.toml`` into a folder: a robot that somebody else could have."""
    (folder / "small").mkdir()
    (folder / "small" / "small.xml").write_text(biped(sole=SPHERE_SOLE))
    (folder / "small" / "robot.toml").write_text(bent("small.xml"))
