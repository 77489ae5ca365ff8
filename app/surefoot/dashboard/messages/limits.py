"""How far away each limit is, and what the last push was against the capture bound. Immutable; made by the watch."""

from dataclasses import dataclass

from surefoot.momentum.zmp import linear_impulse


@dataclass(frozen=True, slots=True, kw_only=True)
class StepBound:
    """What one emergency step could have caught.

    Attributes:
        bound_ns: J_cap1, from the capture point and the feet where the push started; at least J_cap.
        ahead_m, back_m, aside_m: how far from the foot that stands the other one can be set down.
        landing_s: from the start of the push until it stands.
    """

    bound_ns: float
    ahead_m: float
    back_m: float
    aside_m: float
    landing_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class PushBound:
    """The last push against what no controller could survive without a step or a swing of its trunk.

    Attributes:
        start_s, duration_s: of the push.
        direction_deg: 0 = forward, 90 = to the left.
        impulse_ns: J, what the push gives in all.
        bound_ns: J_cap(T) for its duration, from the capture point and the soles where it started.
        omega: natural frequency [rad/s] of the CoM then.
        link: where it acts; the bound is that of a push through the CoM.
        step: where the robot steps when it must and the push is over before a step lands; None elsewhere, and of a push
            that came while a foot was in the air.
    """

    start_s: float
    duration_s: float
    direction_deg: float
    impulse_ns: float
    bound_ns: float
    omega: float
    link: str
    step: StepBound | None = None

    @property
    def eta(self) -> float:
        """J / J_cap: at 1 the capture point is driven to the edge; infinite where nothing can be borne."""
        return _share(self.impulse_ns, self.bound_ns)

    @property
    def eta_1(self) -> float | None:
        """J / J_cap1: at 1 one step just catches it; None where no step is to be made."""
        return None if self.step is None else _share(self.impulse_ns, self.step.bound_ns)

    def linear_ns(self, com_damping: float) -> float:
        """J_lin = J_cap omega / K_D: the impulse at which a PD law on the CoM has used up the sole."""
        return linear_impulse(self.bound_ns, self.omega, com_damping)


@dataclass(frozen=True, slots=True, kw_only=True)
class Gauge:
    """One limit.

    Attributes:
        name: short and stable: ``zmp``, ``dcm``, ``torque``, ``joint`` or ``friction``.
        label: which joint, foot or edge it is about.
        value: what is left [mm, N m, mrad] or, for friction, the share that is used [-].
        unit: of ``value``.
        used: 0 in the middle, 1 at the limit, more beyond; NaN where nothing can be said.
    """

    name: str
    label: str
    value: float
    unit: str
    used: float


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitMargins:
    """All limits of one moment.

    Attributes:
        gauges: in the order in which they are shown.
        push: the last push that began, if any.
    """

    gauges: tuple[Gauge, ...] = ()
    push: PushBound | None = None

    @property
    def nearest(self) -> Gauge | None:
        """The limit most used up now."""
        known = [gauge for gauge in self.gauges if gauge.used == gauge.used]
        return max(known, key=lambda gauge: gauge.used) if known else None

    def gauge(self, name: str) -> Gauge | None:
        """The gauge of that name, if there is one."""
        return next((gauge for gauge in self.gauges if gauge.name == name), None)


def _share(impulse_ns: float, bound_ns: float) -> float:
    return impulse_ns / bound_ns if bound_ns > 0.0 else float("inf")
