"""What ``surefoot run`` prints for a person: the figures of the summary."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from surefoot.number_text import decimals_for, figure, fixed

if TYPE_CHECKING:
    from surefoot.robot.description import RobotDescription

_SETTINGS = "controller."
_MOST_PEAKS = 5


def print_summary(summary: dict[str, Any], robot: str) -> None:
    """Print it: the outcome in a line, the figures in a table, the warnings.

    Args:
        summary: of the run.
        robot: as scenarios name it.
    """
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from surefoot.experiments.scenario.robots import robot_named
    from surefoot.simulation.falls import LIMITS, fall_cause_text
    from surefoot.simulation.walk_causes import first_cause_text

    console, described = Console(), robot_named(robot)
    ratios = described.sizes
    if summary["fell"]:
        outcome = (
            f"[bold red]fell[/] at {summary['fall_time_s']:.3f} s: {fall_cause_text(summary['fall_cause'], ratios)}"
        )
    else:
        outcome = f"[bold green]stands[/] after {summary['duration_s']:.3f} s"
    console.print(f"{summary['scenario']} under {summary['controller']}: {outcome}")
    table = Table(show_header=False, box=None)
    if summary["error"]:
        table.add_row("error", escape(summary["error"]))
    if summary["first_limit"]:
        table.add_row("first limit", f"{LIMITS[summary['first_limit']]}, at {summary['first_limit_time_s']:.3f} s")
    if began := summary.get("fall_first_cause"):
        table.add_row(
            "first cause", f"{first_cause_text(began, ratios)}, at {summary['fall_first_cause_time_s']:.3f} s"
        )
    table.add_row("least ZMP margin", _margin_in_words(summary))
    if sizes := summary.get("in_proportion"):
        table.add_row("in proportion", escape(_sizes_in_words(sizes, described.name)))
    for push in summary.get("pushes", ()):
        table.add_row("push", escape(_push_in_words(push, summary["duration_s"])))
    if "steps_made" in summary:
        table.add_row("walk", _walk_in_words(summary))
    table.add_row("CoM error", _error_in_words(summary))
    if "dcm_error_p50_mm" in summary:
        table.add_row("estimator", _belief_in_words(summary))
    infeasible = f"{summary['qp_infeasible_ticks']} ticks"
    if summary["qp_infeasible_first_s"] is not None:
        infeasible += f", first at {summary['qp_infeasible_first_s']:.3f} s"
    table.add_row("QP infeasible", f"{infeasible}; fallback {summary['fallback_ticks']} ticks")
    table.add_row("peak torques", escape(_peaks_in_words(summary["torque_peak_nm"], described)))
    if summary["tick_us_median"] is not None:  # there is none where the first tick failed
        tick = f"control tick {summary['tick_us_median']:.0f} us (p99 {summary['tick_us_p99']:.0f})"
        table.add_row("speed", f"{summary['real_time_factor']:.1f} x real time, {tick}")
    console.print(table)
    for warning in summary["warnings"]:
        console.print(f"[yellow]warning[/] {warning}")


def _sizes_in_words(sizes: Mapping[str, Any], name: str) -> str:
    """As ``--set`` takes them; of the controller's settings, which are many, only that they are."""
    told = [f"{path} = {value}" for path, value in sizes.items() if not path.startswith(_SETTINGS)]
    gains = sum(path.startswith(_SETTINGS) for path in sizes)
    return f"to {name}: " + ", ".join([*told, *([f"{gains} of the controller's gains"] if gains else [])])


def _margin_in_words(summary: Mapping[str, Any]) -> str:
    """The least of the run; of a fall, in which the ZMP ends at the edge anyhow, first that of before."""
    least = _millimetres(summary["zmp_margin_min_m"], 1)
    if not summary["fell"]:
        return least
    return f"{_before(summary, 'zmp_margin_min_before_limit_m')}{least} until the fall"


def _error_in_words(summary: Mapping[str, Any]) -> str:
    """The greatest and the last of the run; of a fall, which makes it what a fall is, first that of before."""
    most = _millimetres(summary["com_error_max_m"], 1)
    if not summary["fell"]:
        return f"{most} at most, {_millimetres(summary['com_error_final_m'], 2)} at the end"
    return f"at most {_before(summary, 'com_error_max_before_limit_m')}{most} until the fall"


def _before(summary: Mapping[str, Any], key: str) -> str:
    """A figure of the time until something went wrong; nothing where that was at once."""
    if summary[key] is None:
        return ""
    cause = "cause" if summary.get("fall_first_cause") else "limit"
    return f"{_millimetres(summary[key], 1)} before the first {cause}, "


def _peaks_in_words(peaks: Mapping[str, float], robot: "RobotDescription") -> str:
    """Those nearest to their limits; a robot of thirty joints has too many to look at."""
    ratios = robot.sizes
    decimals = decimals_for(ratios.weight * ratios.leg)  # moments: weight times length
    share = {joint.key: peaks[joint.key] / joint.torque_limit_nm for joint in robot.joints}
    worst = sorted(peaks, key=lambda name: -share[name])[:_MOST_PEAKS]
    said = ", ".join(f"{name}: {fixed(peaks[name], decimals)} ({100.0 * share[name]:.0f} %)" for name in worst)
    left = len(peaks) - len(worst)
    return f"{said} N m (of the limit)" + (f", and {left} more" if left > 0 else "")


def _millimetres(length_m: float | None, decimals: int) -> str:
    return "-" if length_m is None else f"{fixed(1e3 * length_m, decimals)} mm"


def _push_in_words(push: Mapping[str, Any], ended_s: float) -> str:
    """J, J_cap and eta of a push; that it is on a link, and that it never came where the run ended before."""
    from surefoot.simulation.external_forces import WHOLE_ROBOT

    impulse, bound = figure(push["impulse_ns"]), figure(push["bound_ns"])
    if push["eta"] is None:
        text = f"J = {impulse} N s; at rest the CoM is beyond the soles' edge"
    else:
        text = f"eta = J / J_cap = {impulse} / {bound} N s = {push['eta']:.3f}"
    if push["link"] != WHOLE_ROBOT:
        text += f"; the push is on the {push['link']}, J_cap through the CoM"
    return f"at {push['start_s']:g} s: {text}" + ("; it did not come" if push["start_s"] >= ended_s else "")


def _belief_in_words(summary: dict[str, Any]) -> str:
    dcm = f"DCM error {summary['dcm_error_p50_mm']:.1f} mm (p99 {summary['dcm_error_p99_mm']:.1f})"
    drift = f"drift {summary['position_drift_mm']:.1f} mm and {fixed(summary['yaw_drift_deg'], 2)} degrees of heading"
    return f"{summary['estimator']}: {dcm}, tilt error p99 {summary['tilt_error_p99_deg']:.2f} degrees, {drift}"


def _walk_in_words(summary: dict[str, Any]) -> str:
    made = f"{summary['steps_made']} of {summary['steps_planned']} steps"
    way = f"{fixed(summary['distance_m'], 2)} m at {fixed(summary['mean_speed_m_s'], 2)} m/s"
    completed = "completed" if summary["walk_completed"] else "not completed"
    cost = summary["cost_of_transport"]
    return f"{made}, {way}, {completed}" + (f"; cost of transport {cost:.2f}" if cost is not None else "")
