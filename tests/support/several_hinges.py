"""A made-up biped as people write an MJCF by hand: hip of three hinges in the thigh's body, ankle of two in the foot's.

Its waist has two in the trunk's body, its one shoulder two in the arm's; axes are askew, anchors differ within a body,
and the base may be. The same robot with one hinge a body is its twin: MuJoCo wants some mass in each link that
moves, and ``TRACE_KG`` is next to the least that it takes.
"""

from collections.abc import Sequence

TRACE_KG = 2e-15
HIP, KNEE, ANKLE = ("hip_x", "hip_z", "hip_y"), ("knee",), ("ankle_y", "ankle_x")
AXES = {
    "hip_x": ("1 0 0.1", "0 0 0.01"),
    "hip_z": ("0 0.05 1", "0 0.005 0"),
    "hip_y": ("0 1 0", "0.01 0 0"),
    "knee": ("0 -1 0", "0 0 0.02"),
    "ankle_y": ("0 1 0", "0 0 0.055"),
    "ankle_x": ("1 0 0.3", "0 0 0.03"),
    "waist_z": ("0 0 1", "0 0 0"),
    "waist_y": ("0 1 0.1", "0 0 0.03"),
    "shoulder_1": ("2 1 1", "0 0 0"),
    "shoulder_2": ("0 -1 1", "0 0.01 0"),
}


UPRIGHT = """<body name="pelvis" {pose}>
      <freejoint name="root"/>
      <inertial pos="0 0 0" mass="4" diaginertia="0.02 0.015 0.025"/>
      {parts}
    </body>"""
# y up, z forward, x to the left
Y_UP = """<body name="pelvis" {pose}>
      <freejoint name="root"/>
      <inertial pos="0 0 0" mass="4" diaginertia="0.015 0.025 0.02"/>
      <frame quat="0.5 -0.5 -0.5 -0.5">{parts}</frame>
    </body>"""


def several_hinges(
    *, apart: bool = False, joint: str = "", base: str = UPRIGHT, pose: str = 'pos="0 0 0.7"', extra: str = ""
) -> str:
    """MJCF text.

    Args:
        apart: one hinge a body, the others carried by links of ``TRACE_KG``.
        joint: attributes of every joint.
        base: ``UPRIGHT`` or ``Y_UP``: how the base's frame lies.
        pose: of the base.
        extra: elements beside the world.
    """
    legs = "".join(_leg(side, y, apart, joint) for side, y in (("left", 0.09), ("right", -0.09)))
    arm = _body("arm", "0 0.15 0.2", ("shoulder_1", "shoulder_2"), 0.8, "0.08 0.08 -0.08", "", apart=apart, joint=joint)
    trunk = _body("trunk", "0 0 0.06", ("waist_z", "waist_y"), 7.0, "0 0 0.15", arm, apart=apart, joint=joint)
    names = [f"{side}_{name}" for side in ("left", "right") for name in (*HIP, *KNEE, *ANKLE)]
    names += ["waist_z", "waist_y", "shoulder_1", "shoulder_2"]
    motors = "".join(f'<motor name="{name}" joint="{name}" gear="60" ctrlrange="-1 1"/>' for name in names)
    return f"""
<mujoco model="several">
  <compiler angle="radian"/>
  <worldbody>
    {base.format(pose=pose, parts=legs + trunk)}
  </worldbody>
  <actuator>{motors}</actuator>
  {extra}
</mujoco>"""


def _leg(side: str, y: float, apart: bool, joint: str) -> str:
    sole = '<geom type="box" size="0.1 0.04 0.01" pos="0.03 0 -0.02" group="3"/>'
    foot = _body(f"{side}_foot", "0 0 -0.3", ANKLE, 0.8, "0.02 0 -0.01", sole, side, apart, joint)
    shin = _body(f"{side}_shin", "0 0 -0.3", KNEE, 1.8, "0 0 -0.12", foot, side, apart, joint)
    return _body(f"{side}_thigh", f"0 {y} -0.04", HIP, 2.5, "0 0 -0.1", shin, side, apart, joint)


def _body(
    name: str,
    place: str,
    hinges: Sequence[str],
    mass: float,
    com: str,
    parts: str,
    side: str = "",
    apart: bool = False,
    joint: str = "",
) -> str:
    drawn = [
        f'<joint name="{side}{"_" if side else ""}{hinge}" axis="{AXES[hinge][0]}" pos="{AXES[hinge][1]}" '
        f'range="-2 2" armature="0.01" {joint}/>'
        for hinge in hinges
    ]
    own = f'<inertial pos="{com}" mass="{mass}" diaginertia="0.012 0.01 0.004"/>{parts}'
    if not apart:
        return f'<body name="{name}" pos="{place}">{"".join(drawn)}{own}</body>'
    trace = f'<inertial pos="0 0 0" mass="{TRACE_KG}" diaginertia="{TRACE_KG} {TRACE_KG} {TRACE_KG}"/>'
    opened = "".join(
        f'<body name="{name}_{i}" pos="{place if i == 0 else "0 0 0"}">{hinge}{trace}'
        for i, hinge in enumerate(drawn[:-1])
    )
    last = f'<body name="{name}" pos="{"0 0 0" if len(drawn) > 1 else place}">{drawn[-1]}{own}</body>'
    return opened + last + "</body>" * (len(drawn) - 1)
