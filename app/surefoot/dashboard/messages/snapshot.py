"""What the page knows of the world: one immutable picture, published about 60 times a second."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.messages.believed import BelievedRobot
from surefoot.dashboard.messages.events import Event
from surefoot.dashboard.messages.footprint import Footprint
from surefoot.dashboard.messages.limits import LimitMargins
from surefoot.dashboard.messages.sensing import PERFECT_SENSING, Sensing
from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.messages.stone_view import StoneView
from surefoot.gait.dcm_plan import NO_PLAN
from surefoot.gait.progress import Progress
from surefoot.simulation.terrain import LEVEL, Terrain

LOADED_N = 20.0  # a foot of Bip that feels less is shown as one that carries nothing; others' in proportion
DIVERGED_M = 1e-3  # a millimetre is 1000 times what two solvers differ by, and a tenth of what a person sees


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Geometry:
    """Where things are, world frame, metres.

    Attributes:
        qpos: (7 + n,) position of the base, quaternion (w, x, y, z), n joint angles.
        com: (3,) centre of mass.
        ground_rotation: (3, 3) ground axes to world; its third column is the ground's normal.
        ground_pivot: (3,) point of the ground.
        support_origin: (3,) P of the stance foot, or midway between both; the points below are drawn as high.
        zmp_measured, zmp_commanded, capture: (2,); NaN where unknown.
        soles: (2, n, 3) corners of both soles.
        support_polygon: (n, 3) hull of the soles that carry load; (0, 3) when none does.
        contacts: (n, 6) point, and force on the robot [N].
        stones: what is to be seen of each stone.
        trail: (n, 6) past measured ZMP, CoM projection and capture point: x, y each.
        pulls: (n, 9) held point, hand, force on the link [N].
        footprints: where the next steps are to be, at most 4, the first one first.
        plan_ahead: (n, 4) ZMP and capture point as a walk has planned them, x, y each, now first.
        standing: feet that are to keep their load, 0 left, 1 right; of a run that was saved, those that carry one.
        believed: the robot as an estimator has it; None where there is none.
    """

    qpos: np.ndarray
    com: np.ndarray
    ground_rotation: np.ndarray
    ground_pivot: np.ndarray
    support_origin: np.ndarray
    zmp_measured: np.ndarray
    zmp_commanded: np.ndarray
    capture: np.ndarray
    soles: np.ndarray
    support_polygon: np.ndarray
    contacts: np.ndarray
    stones: tuple[StoneView, ...]
    trail: np.ndarray
    pulls: np.ndarray = field(default_factory=lambda: np.empty((0, 9)))
    footprints: tuple[Footprint, ...] = ()
    plan_ahead: np.ndarray = field(default_factory=lambda: NO_PLAN)
    standing: tuple[int, ...] = ()
    believed: BelievedRobot | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BalanceStatus:
    """How the balance is doing.

    Attributes:
        status: of the last tick: solved, holding or fallback; ``ready`` before the first.
        status_help: what that means.
        guard_active, guard_relaxed, gate_active, infeasible: flags of the last tick.
        zmp_margin_m: distance of the measured ZMP from the sole's edge; NaN when unloaded.
        foot_forces_n: vertical force on the left and the right foot.
        torques_nm: (n,) torques applied at the joints.
        fall_cause, fall_time_s: named cause of the fall, if any.
        fall_text: the whole story in a line.
        first_limit, first_limit_s: the limit that went first on the way to the fall, if any, and when.
        ended: the fall has been shown; only a reset goes on from here.
    """

    status: str = "ready"
    status_help: str = "no tick yet"
    guard_active: bool = False
    guard_relaxed: bool = False
    gate_active: bool = False
    infeasible: bool = False
    zmp_margin_m: float = float("nan")
    foot_forces_n: tuple[float, float] = (0.0, 0.0)
    torques_nm: np.ndarray
    fall_cause: str | None = None
    fall_time_s: float | None = None
    fall_text: str = ""
    first_limit: str | None = None
    first_limit_s: float | None = None
    ended: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotLimits:
    """What the plots are held against; constant during a run.

    Attributes:
        sagittal_mm: rear and front edge of the support, relative to P (to the middle of both P in double support).
        lateral_mm: right and left edge likewise.
        ankle_frontal_nm, ankle_sagittal_nm: torque limits of the plotted ankle.
        ankle_frontal, ankle_sagittal: the paper's names of these torques.
    """

    sagittal_mm: tuple[float, float]
    lateral_mm: tuple[float, float]
    ankle_frontal_nm: float
    ankle_sagittal_nm: float
    ankle_frontal: str
    ankle_sagittal: str


@dataclass(frozen=True, slots=True, kw_only=True)
class BiasView:
    """What the delta_P reference active will do, standing in the scenario's posture.

    Attributes:
        reference_nm: frontal and sagittal delta_P^ref.
        frontal_nm, sagittal_nm: admissible interval of each, alone; None when the posture cannot be solved.
        displacement_mm: predicted CoM displacement, forward and to the left.
        outside: which of the two lie outside, in words.
    """

    reference_nm: tuple[float, float]
    frontal_nm: tuple[float, float] | None
    sagittal_nm: tuple[float, float] | None
    displacement_mm: tuple[float, float]
    outside: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class TimelineView:
    """The past that can be gone back to; simulated seconds since the start of the run.

    Attributes:
        oldest_s, newest_s: what is kept.
        now_s: where the run is; before ``newest_s`` it is seen again as it was.
        marks: events worth a mark, in the order in which they were told, those ahead of ``now_s`` included.
        coming_s: after a fork, when the disturbances that will be repeated come.
        repeat: whether they will.
        seeks: how often the run has been sent to another instant of it.
        sought_s: the last of these instants; 0 before any.
    """

    oldest_s: float
    newest_s: float
    now_s: float
    marks: tuple[Event, ...]
    coming_s: tuple[float, ...]
    repeat: bool
    seeks: int = 0
    sought_s: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SettingsChange:
    """A change of controller and settings.

    Attributes:
        controller: name before and after.
        values: name, value before and value after of every setting that it changed.
    """

    controller: tuple[str, str]
    values: tuple[tuple[str, Any, Any], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class TuningView:
    """What can be undone, and how it would be without a person's changes.

    Attributes:
        defaults: settings of scenario and controller.
        undo, redo: the change that would be taken back, or made again.
        steps: how many can be undone.
    """

    defaults: ControllerSettings
    undo: SettingsChange | None
    redo: SettingsChange | None
    steps: int


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkOutcome:
    """What became of a link that was opened.

    Attributes:
        ticket: of the command that asked for it.
        refused: why it was not started; None when it was.
    """

    ticket: str
    refused: str | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Snapshot:
    """One picture of everything the page shows.

    Attributes:
        number: counts pictures.
        run: counts resets and scenario changes.
        time_s: simulated time.
        playing, speed: as asked for.
        real_time_factor: simulated seconds per second of the wall clock, over the last second or so.
        scenario, controller: names.
        robot: which one it is; the same object as long as it is the same robot.
        support: left, right or double.
        settings: of the controller active.
        friction: of ground and stones.
        bias: what the delta_P reference does.
        geometry, balance: see there.
        traces: (n, len(TRACE_COLUMNS)) rows for the plots, oldest first; coordinates relative to ``support_origin`` of
            the geometry.
        limits: what they are held against.
        events: newest first.
        headroom: how far away each limit is, and what the last push was against the capture bound.
        timeline: the past that can be gone back to.
        tuning: what can be undone of the settings.
        twin: the second robot of a twin run, if there is one.
        links: what became of the last links that were opened, newest last.
        terrain: what stands on the ground from the start; the same object as long as it does.
        walk: how far the robot has come on its way; None where it only stands.
        changes: what sets the scenario apart from the shipped one of its name, see ``changes_of``; None where there is
            none, or nothing that could be said.
        sensing: its sensors and its estimator; the same object as long as they are the same.
    """

    number: int
    run: int
    time_s: float
    playing: bool
    speed: float
    real_time_factor: float
    scenario: str
    robot: ShownRobot
    controller: str
    support: str
    settings: ControllerSettings
    friction: float
    bias: BiasView
    geometry: Geometry
    balance: BalanceStatus
    traces: np.ndarray
    limits: PlotLimits
    events: tuple[Event, ...]
    headroom: LimitMargins
    timeline: TimelineView
    tuning: TuningView
    twin: "TwinView | None" = None
    links: tuple[LinkOutcome, ...] = ()
    terrain: Terrain = LEVEL
    walk: Progress | None = None
    changes: Mapping[str, Any] | None = field(default_factory=dict)
    sensing: Sensing = PERFECT_SENSING


@dataclass(frozen=True, slots=True, kw_only=True)
class Divergence:
    """Where two robots went apart.

    Attributes:
        time_s: of the first tick at which their CoMs were more than ``DIVERGED_M`` apart.
        distance_mm: how far they were at that tick.
        after: the last thing that was done to them before, and when; None when nothing was.
    """

    time_s: float
    distance_mm: float
    after: Event | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TwinView:
    """The second robot, and how the two compare.

    Attributes:
        other: its own picture; None while its process starts.
        divergence: where the two went apart, if they did.
        marks: what was done to them in this run, oldest first.
        table: (n, len(TWIN_COLUMNS)) rows for the plots, oldest first; they end where one has been shown to its end.
    """

    other: Snapshot | None = None
    divergence: Divergence | None = None
    marks: tuple[Event, ...] = ()
    table: np.ndarray
