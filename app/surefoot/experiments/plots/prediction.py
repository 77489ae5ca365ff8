"""The prediction: margin of the reference's own ZMP, and when the hard QP really became infeasible."""

from pathlib import Path

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import PREDICTED
from surefoot.experiments.plots import style


def draw_prediction(f: Findings, folder: Path) -> None:
    """One small panel a swing."""
    with style.figure(4.9) as fig:
        panels = fig.subplots(2, 4, sharey=True)
        for ax, scenario in zip(panels.flat, PREDICTED, strict=True):
            plan, measured = f.predictions[scenario], f.run(scenario, "optimization").summary["qp_infeasible_first_s"]
            ax.axhspan(-60, 0, facecolor=style.FALLS, alpha=0.5, zorder=0)
            ax.plot(plan.time_s, 1e3 * plan.margin, color=style.BLUE, label="ZMP of the reference, predicted")
            ax.plot(
                plan.time_s,
                1e3 * plan.point_mass_margin,
                color=style.GREY,
                lw=1.1,
                zorder=1.9,
                label="the same for a point mass",
            )
            if measured is not None:
                ax.axvline(measured, color=style.VERMILLION, ls=(0, (4, 1.6)), label="QP infeasible, measured")
            if plan.infeasible_s is not None:
                ax.plot(
                    plan.infeasible_s,
                    0.0,
                    marker="o",
                    ms=6,
                    mfc="white",
                    color=style.BLACK,
                    ls="none",
                    label="leaves the sole, predicted",
                )
                ax.set_xlim(plan.infeasible_s - 0.12, plan.infeasible_s + 0.18)
                ax.set_xticks([round(plan.infeasible_s - 0.1, 1), round(plan.infeasible_s + 0.1, 1)])
            ax.set_ylim(-40, 80)
            title = scenario.removeprefix("paper_").removeprefix("predict_").replace("_", " ")
            ax.set_title(title, fontsize=8.5)
        for ax in panels[:, 0]:
            ax.set_ylabel("margin to the edge [mm]")
        for ax in panels[1]:
            ax.set_xlabel(style.TIME)
        style.shared_legend(fig, panels[0, 0], 2)
        style.save(fig, folder, "prediction")
