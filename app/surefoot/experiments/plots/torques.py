"""Figures 8 and 9: ankle torques of both controllers, and delta_P commanded and measured."""

from pathlib import Path

from surefoot.experiments.paper.findings import FRONTAL, SAGITTAL, Findings
from surefoot.experiments.paper.plan import LATCHED, SWING
from surefoot.experiments.plots import style

_FROM_S, _TO_S = 0.8, 1.9


def draw_figure_8(f: Findings, folder: Path) -> None:
    """Gamma_5 and Gamma_6 of both controllers."""
    runs = [
        f.run(SWING, "optimization"),
        f.run(SWING, "optimization", LATCHED),
        f.run(SWING, "two-part"),
    ]
    since = runs[1].summary["qp_infeasible_first_s"]
    with style.figure(5.0) as fig:
        panels = fig.subplots(2, 1, sharex=True)
        for ax, column, title in (
            (panels[0], FRONTAL, r"(a) frontal plane: $\Gamma_5$ of the left ankle"),
            (panels[1], SAGITTAL, r"(b) sagittal plane: $\Gamma_6$ of the left ankle"),
        ):
            for result in runs:
                time, torque = result.column("time_s"), result.column(column)
                look = style.LINES[result.case.row]
                ax.plot(time, torque, label=style.NAMES[result.case.row], **look)
                if result.fell:
                    ax.plot(time[-1], torque[-1], marker="X", ms=7, color=look["color"], ls="none")
            style.mark_time(ax, since, f"{since or 0.0:.2f} s: QP infeasible")
            ax.set_title(title)
            ax.set_ylabel("torque [N m]")
            ax.set_xlim(_FROM_S, _TO_S)
        style.shared_legend(fig, panels[0], 3)
        panels[1].set_xlabel(style.TIME)
        style.save(fig, folder, "figure_8")


def draw_figure_9(f: Findings, folder: Path) -> None:
    """delta_P about the point below the left ankle, with the signs of the paper's axes."""
    run, plan = f.run(SWING, "two-part"), f.predictions[SWING]
    time = run.column("time_s")
    with style.figure(5.0) as fig:
        panels = fig.subplots(2, 1, sharex=True)
        for ax, axis, sign, title in (
            (panels[0], "y", -1.0, r"(a) sagittal plane: $\delta_{Pz}$, about the paper's lateral axis z"),
            (panels[1], "x", 1.0, r"(b) frontal plane: $\delta_{Px}$, about the forward axis x"),
        ):
            own = sign * plan.delta[:, "xyz".index(axis)]
            ax.axhline(0.0, color=style.GREY, lw=1.0)
            ax.plot(plan.time_s, own, label="of the reference's own motion", **style.LINES["reference"])
            ax.plot(time, sign * run.column(f"delta_commanded_{axis}_nm"), color=style.SKY, lw=3.2, label="commanded")
            ax.plot(time, sign * run.column(f"delta_measured_{axis}_nm"), color=style.BLUE, lw=1.1, label="measured")
            ax.set_title(title)
            ax.set_ylabel(r"$\delta_P$ [N m]")
            ax.set_xlim(_FROM_S, _TO_S)
        style.shared_legend(fig, panels[0], 3)
        panels[1].set_xlabel(style.TIME)
        style.save(fig, folder, "figure_9")
