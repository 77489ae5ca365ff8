"""Sweep a setting and plot it: how far a push moves the CoM, for several stiffnesses.

Usage: .venv/bin/python scripts/examples/02_sweep_setting.py [PICTURE.png]
"""

import sys

import matplotlib
import numpy as np

import surefoot

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STIFFNESSES = (30.0, 60.0, 90.0, 120.0)

figure, axes = plt.subplots(figsize=(7.0, 3.5), layout="constrained")
for stiffness in STIFFNESSES:
    changes = {"duration_s": 3.0, "controller.com_stiffness": stiffness, "controller.com_damping": 1.8 * stiffness**0.5}
    result = surefoot.run("push_left", changes=changes)
    away_mm = 1e3 * (result.column("com_y_m") - result.column("com_ref_y_m"))
    end = f"fell at {result.fall_time_s:.2f} s" if result.fell else f"at most {np.abs(away_mm).max():.0f} mm"
    print(f"com_stiffness {stiffness:g}: {end}")
    axes.plot(result.column("time_s"), away_mm, label=f"{stiffness:g}: {end}")
axes.set(xlabel="time [s]", ylabel="CoM from its reference, lateral [mm]", title="A push to the left, com_stiffness")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "sweep.png", dpi=120)
