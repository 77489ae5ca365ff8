"""The report of ``surefoot robot check`` as text."""

from collections.abc import Mapping
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from surefoot.number_text import fixed

_ONE_DECIMAL_FROM = 10.0  # N m; below, two
_RANGE = "nearest to an end of its range (0 %: in the middle, 100 %: at the end)"


def print_report(report: Mapping[str, Any], console: Console) -> None:
    """Print it: what was found and how, what was changed and left out, and what is in the way."""
    if "mjcf" in report:
        _print_robot(report, console)
        _print_joints(report, console)
        _print_agreement(report["agreement"], console)
        _print_statics(report, console)
        _print_lines("changed in memory, the file stays as it is", report["changed"], console)
        _print_lines("left out", report["dropped"], console)
        _print_lines("simulated, and known to the controllers", report["known"], console)
        _print_lines("simulated, but not known to the controllers", report["notes"], console)
    for problem in report["problems"]:
        console.print(f"[red]{escape(problem['topic'])}[/]: {escape(problem['reason'])}", soft_wrap=True)
        console.print(f"  remedy: {escape(problem['remedy'])}", soft_wrap=True)
    if report["fit"] and report["at_limit"]:
        joints = ", ".join(
            f"{escape(one['joint'])} at {one['percent']:.0f} % of its {one['of']} ({one['support']})"
            for one in report["at_limit"]
        )
        console.print(f"[green]fit[/], but [yellow]at its limit on one foot[/]: {joints}", soft_wrap=True)
    elif report["fit"]:
        console.print("[green]fit[/]: nothing is in the way")
    else:
        console.print(f"[red]not fit[/]: {len(report['problems'])} in the way, named above")


def _print_robot(report: Mapping[str, Any], console: Console) -> None:
    table = Table("what", "found", "how")
    robot = f"{report['joint_count']} joints, {report['dofs']} degrees of freedom, {report['mass_kg']:.2f} kg"
    table.add_row("robot", robot, "")
    for part in ("base", "trunk"):
        if part in report:
            table.add_row(part, escape(report[part]["body"]), escape(report[part]["how"]))
    table.add_row("posture", escape(report["posture"]), "")
    if "legs" in report:
        for side, joints in report["legs"].items():
            table.add_row(
                f"{side} leg, {len(joints)} joints", escape(", ".join(joints)), "on the way from one foot only"
            )
        upper = report["upper_joints"]
        table.add_row(f"upper, {len(upper)} joints", escape(", ".join(upper)) or "none", "in no leg")
    for side, foot in report.get("feet", {}).items():
        table.add_row(f"{side} foot", escape(foot["body"]), escape(foot["how"]))
        if "ankle" in foot:
            ankle = foot["ankle"]
            joints = f"pitch {escape(ankle['pitch'])}, roll {escape(ankle['roll'])}"
            gap = f"{1e3 * ankle['axes_gap_m']:.1f} mm between the axes, {ankle['order']} down the leg"
            table.add_row(f"{side} ankle", f"{joints}; {gap}{_weak(ankle)}", escape(ankle["how"]))
        if "sole" in foot:
            table.add_row(f"{side} sole", _sole(foot["sole"]), escape(foot["sole"]["how"]))
    console.print(table)


def _weak(ankle: Mapping[str, Any]) -> str:
    """What an ankle cannot hold: the whole weight at the edge of its sole; nothing where it can."""
    said = [
        f"{1e3 * ankle['holds_weight_at_m'][name]:.0f} of {1e3 * ankle['sole_edge_at_m'][name]:.0f} mm {where}"
        for name, where in (("pitch", "ahead or back"), ("roll", "aside"))
        if not ankle["holds_sole"][name]
    ]
    return f"; its torque holds the whole weight up to {' and '.join(said)}" if said else ""


def _sole(sole: Mapping[str, Any]) -> str:
    corners = " ".join(f"({fixed(1e3 * x, 0)}, {fixed(1e3 * y, 0)})" for x, y in sole["corners_m"])
    size = f"{1e3 * sole['length_m']:.0f} x {1e3 * sole['width_m']:.0f} mm, {1e3 * sole['ankle_height_m']:.0f} mm below"
    text = f"{size} the ankle; corners from there {corners} mm"
    if sole["tilt_deg"] > 0.5:
        text += f"; tilted by {sole['tilt_deg']:.1f} deg in the posture"
    if sole["area_lost"] > 0.005:
        text += f"; {100.0 * sole['area_lost']:.1f} % smaller than the hull, to have few corners"
    return text


def _print_joints(report: Mapping[str, Any], console: Console) -> None:
    heads = ("joint", "range rad", "posture", "limit N m", "limit from", "rotor kg m2", "damping N m s", "friction N m")
    table = Table(*heads)
    for joint in report["joints"]:
        limit = joint["torque_limit_nm"]
        table.add_row(
            escape(joint["name"]),
            f"{fixed(joint['lower_rad'], 2)} to {fixed(joint['upper_rad'], 2)}",
            fixed(joint["posture_rad"], 2),
            "[red]none[/]" if limit is None else f"{limit:g}",
            joint["limit_source"] or "",
            f"{joint['rotor_inertia_kgm2']:.4g}",
            f"{joint['damping_nms']:.3g}",
            f"{joint['friction_nm']:.3g}",
        )
    console.print(table)


def _print_agreement(found: Mapping[str, Any], console: Console) -> None:
    if found["mass_matrix_difference"] is None:
        return  # it is one of the problems
    console.print(
        f"MuJoCo and Pinocchio: the same {found['dofs']['mujoco']} degrees of freedom and joint names, "
        f"{found['mass_kg']['mujoco']:.3f} kg both; over {found['states']} random states "
        f"M differs by {found['mass_matrix_difference']:.1e}, the CoM by {found['com_difference_m']:.1e} m, "
        f"the bias by {found['bias_difference_nm']:.1e} N m",
        soft_wrap=True,
    )


def _print_statics(report: Mapping[str, Any], console: Console) -> None:
    if "statics" not in report:
        console.print(
            "[yellow]not looked at[/]: soles, cond(H) and statics need what is in the way below", soft_wrap=True
        )
        return
    heads = ("standing still", "CoM height m", "cond(H)", "greatest share of a torque limit", _RANGE)
    table = Table(*heads)
    for statics in report["statics"]:
        if "torque" not in statics:
            table.add_row(statics["support"], "", "", "[red]no such posture[/]", "")
            continue
        torque, bound = statics["torque"], statics["range"]
        how = f" (posture found; {escape(statics['by_rule'])})" if statics["posture"] == "found" else ""
        table.add_row(
            statics["support"] + how,
            f"{statics['com_height_m']:.3f}",
            f"{statics['condition_of_h']:.0f}",
            f"{_percent(torque['percent'])} {escape(torque['joint'])} ({_moment(torque['nm'])} N m)",
            f"{escape(bound['joint'])} at {fixed(bound['rad'], 2)} rad: {_percent(bound['percent'])}",
        )
    console.print(table)


def _percent(value: float) -> str:
    return f"[red]{value:.0f} %[/]" if value > 100.0 else f"{value:.0f} %"


def _moment(value_nm: float) -> str:
    return fixed(value_nm, 1 if abs(value_nm) >= _ONE_DECIMAL_FROM else 2)


def _print_lines(title: str, lines: list[str], console: Console) -> None:
    if lines:
        console.print(f"{title}:")
    for line in lines:
        console.print(f"  {escape(line)}", soft_wrap=True)
