"""Every gain and every switch of the controllers in one frozen object, described once for files, flags and sliders."""

from dataclasses import dataclass, fields
from functools import partial
from typing import Any

import numpy as np

from surefoot.control.setting_kinds import ANKLE_PLOTS as _ANKLES
from surefoot.control.setting_kinds import COM_PLOTS as _COM
from surefoot.control.setting_kinds import DELTA_PLOT as _DELTA
from surefoot.control.setting_kinds import MARGIN_PLOT as _MARGINS
from surefoot.control.setting_kinds import damping as _damping
from surefoot.control.setting_kinds import offset as _offset
from surefoot.control.setting_kinds import stiffness as _stiffness
from surefoot.control.setting_kinds import weight as _weight
from surefoot.dynamics.terms import COM, FOOT_ROWS, PELVIS, UPPER
from surefoot.field_metadata import check_fields, choice, number, switch

_reading, _part = partial(choice, group="equations"), partial(switch, group="equations")  # of the equations


@dataclass(frozen=True, kw_only=True)
class ControllerSettings:
    """Gains and switches; the defaults are those of ``two-part``. Validated in ``__post_init__`` (InvalidInput).

    The help of each field is in its metadata; ``surefoot settings`` prints them all.
    """

    com_stiffness: float = _stiffness(
        "the centre of mass", "a stiffer return to the reference; the ZMP swings wider and saturates sooner", _COM
    )
    com_damping: float = _damping(
        "the centre of mass", "a calmer CoM; too much: jitter in the ankle torques", (*_COM, *_ANKLES)
    )
    pelvis_stiffness: float = _stiffness(
        "the pelvis orientation", "an upright trunk; costs ZMP travel in a push", (*_COM, *_DELTA)
    )
    pelvis_damping: float = _damping(
        "the pelvis orientation", "less sway of the trunk; costs ZMP travel in a push", (*_COM, *_DELTA)
    )
    foot_stiffness: float = _stiffness(
        "the swing foot", "a still free leg; its reaction reaches the stance ankle", _ANKLES
    )
    foot_damping: float = _damping("the swing foot", "a calm free leg; its reaction reaches the stance ankle", _ANKLES)
    lumbar_stiffness: float = _stiffness("the joints in no leg", "a waist that bends less in a push", _DELTA)
    lumbar_damping: float = _damping("the joints in no leg", "a waist that bends more slowly in a push", _DELTA)
    stance_foot_damping: float = number(
        20.0,
        0.0,
        100.0,
        "1/s",
        "a stance foot is asked for -this x its velocity: it follows the ground, not a pose",
        group="gains",
        equation="(23)",
        step=1.0,
        raised="the sole follows the ground slower, a stone under it too",
        watch=("lateral", "forces"),
    )

    delta_ref_sagittal_nm: float = number(
        0.0,
        -900.0,
        900.0,
        "N m",
        "reference of delta_P about the lateral axis: a torque bias that moves the CoM by about -delta_ref/(K_P m h)",
        group="delta",
        equation="(16)",
        step=1.0,
        raised="the CoM moves backward",
        watch=("sagittal", "delta"),
    )
    delta_ref_frontal_nm: float = number(
        0.0,
        -900.0,
        900.0,
        "N m",
        "reference of delta_P about the forward axis: a torque bias that moves the CoM by about +delta_ref/(K_P m h)",
        group="delta",
        equation="(16)",
        step=1.0,
        raised="the CoM moves to the left",
        watch=("lateral", "delta"),
    )
    zmp_margin: float = number(
        0.95,
        0.1,
        1.0,
        "",
        "the ZMP asked for stays in the support polygon scaled by this about its centroid",
        group="delta",
        equation="(14), (15)",
        step=0.01,
        raised="more of the sole is used, less is kept in reserve",
        watch=(*_COM, *_MARGINS),
    )

    p_point: str = _reading(
        "ankle",
        ("ground", "ankle", "offset"),
        "where P is: below the ankle as in the paper, at it, where the law is exact, or at an offset from it",
        equation="(28)",
        watch=("delta", "ankles"),
    )
    p_offset_x_m: float = _offset("forward")
    p_offset_y_m: float = _offset("to the left")
    p_offset_z_m: float = _offset("up")
    tangential_term: bool = _part(
        True,
        "keep the tangential force times ankle height in the ankle torque (matters with P on the ground)",
        equation="(28)",
        watch=_ANKLES,
    )
    saturation: str = _reading(
        "consistent",
        ("none", "clip", "consistent"),
        "ZMP outside its limits: let it, clip the "
        "ankle torque only, or change the CoM acceleration so that all torques agree",
        equation="(14), (15)",
        watch=(*_COM, *_MARGINS),
    )
    composition: str = _reading(
        "consistent",
        ("consistent", "override"),
        "ankle torques enter the solution of the other joints, or replace theirs afterwards",
        equation="(17), (28)",
        watch=_ANKLES,
    )
    other_joints: str = _reading(
        "qp",
        ("qp", "inverse-dynamics"),
        "the other joints: by the contact QP, or by inverse dynamics without cones",
        equation="(17), (22)",
        watch=("forces", "delta"),
        formerly="rest",
    )
    guard: bool = _part(
        True,
        "capture guard: the ZMP must be beyond the capture point before that nears an edge",
        equation="(14), (15)",
        watch=(*_MARGINS, "lateral"),
    )
    roll_gate: bool = _part(
        False,
        "rolled-sole gate: a stance sole rolled by more than 2 degrees stands on a stone; "
        "the ZMP is then not confined to it. Not needed where the QP weighs the CoM more than the "
        "posture",
        equation="(28)",
        watch=("lateral", "margins"),
    )
    double_support_split: bool = _part(
        True,
        "share the load between the feet by the lever rule; off: each ankle is "
        "given the whole F_N, and both feet roll to their stops",
        equation="(28)",
        watch=("forces", "ankles"),
    )
    joint_ranges: bool = _part(
        True,
        "the QPs keep every joint in its range, and the motion gives way; off: the motion is kept, and a joint may "
        "meet its stop, as an ankle does whose sole rolls on a stone in a walk",
        equation="(17)",
        watch=("lateral", *_ANKLES),
    )
    latched: bool = _part(
        False,
        "optimization: once infeasible, hold the last torques for ever (the paper's Figure "
        "8) instead of trying again each tick",
        equation="(17)",
        watch=_ANKLES,
    )
    delta_form: str = _reading(
        "full",
        ("full", "diagonal", "printed"),
        "delta_P by (5), or by the planar form with diagonal inertias, right or swapped as printed",
        equation="(5)-(7)",
        watch=_DELTA,
    )
    delta_source: str = _reading(
        "commanded",
        ("commanded", "qp", "gravity"),
        "delta_P of the commanded q'', of the q'' that a soft QP allows, or zero: gravity compensation only",
        equation="(25), (28)",
        watch=_DELTA,
    )

    feedforward: str = _reading(
        "acceleration",
        ("acceleration", "planned", "none"),
        "the reference's motion enters as kappa_d'', as the planned ZMP (zeta = zeta_ref + feedback), or not at all",
        equation="(11)-(13), (25)",
        watch=_COM,
    )

    # An ankle at its stop then costs posture, not balance: 3 was too little for a stone under the outer edge, 30 and
    # more lost the sideways push on two feet (static/help/what_the_law_buys.md).
    com_weight: float = _weight(10.0, "the centre of mass", _COM)
    pelvis_weight: float = _weight(1.0, "the pelvis orientation", _DELTA)
    foot_weight: float = _weight(0.1, "the swing foot", _DELTA)  # the free leg is the counterweight
    lumbar_weight: float = _weight(1.0, "the joints in no leg", _DELTA)
    assumed_friction: float = number(
        0.6,
        0.05,
        2.0,
        "",
        "friction coefficient the QPs count on",
        group="weights",
        equation="(17)",
        step=0.05,
        raised="harder pushes against the ground sideways; beyond the true friction the soles slip",
        watch=("forces",),
    )
    ankle_limits: str = choice(
        "auto",
        ("auto", "law", "qp"),
        "an ankle of which the law asks more than its motor gives: it gives what it can, and no other joint knows "
        "(law), or the QP decides the ankles too in that tick, within their limits (qp); auto: qp where the robot's "
        "ankles cannot hold its weight at the edge of a sole, law elsewhere",
        group="weights",
        equation="(17), (28)",
        watch=_ANKLES,
    )
    joint_friction_compensation: bool = switch(
        False,
        "the motors also give what the robot file's friction and damping of the joints take",
        group="weights",
        equation="(1)",
        watch=(*_COM, *_ANKLES),
    )
    solver: str = choice("daqp", ("daqp", "clarabel"), "QP solver", group="weights", equation="(17)", watch=("ticks",))

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "controller")

    def stiffness(self, rows: int) -> np.ndarray:
        """Diagonal of K_P (rows,) [1/s2]."""
        return _per_row(rows, self.com_stiffness, self.pelvis_stiffness, self.foot_stiffness, self.lumbar_stiffness)

    def damping(self, rows: int) -> np.ndarray:
        """Diagonal of K_D (rows,) [1/s]."""
        return _per_row(rows, self.com_damping, self.pelvis_damping, self.foot_damping, self.lumbar_damping)

    def weights(self, rows: int) -> np.ndarray:
        """Weights of the rows of kappa'' (rows,)."""
        return _per_row(rows, self.com_weight, self.pelvis_weight, self.foot_weight, self.lumbar_weight)


def settings_differences(one: ControllerSettings, other: ControllerSettings) -> tuple[tuple[str, Any, Any], ...]:
    """Name and both values of every setting in which two differ, in the order of the fields."""
    pairs = ((field.name, getattr(one, field.name), getattr(other, field.name)) for field in fields(ControllerSettings))
    return tuple((name, a, b) for name, a, b in pairs if a != b)


def _per_row(rows: int, com: float, pelvis: float, foot: float, upper: float) -> np.ndarray:
    values = np.empty(rows)
    values[COM], values[PELVIS], values[UPPER] = com, pelvis, upper
    for foot_rows in FOOT_ROWS:
        values[foot_rows] = foot
    return values
