"""Run a scenario with two controllers and see which one falls.

Usage: .venv/bin/python scripts/examples/00_run_scenario.py
"""

import surefoot

STONE = {"stones.0.height_m": 0.012}

for controller in ("optimization", "two-part"):
    result = surefoot.run("stone_outer_edge", controller, changes=STONE)
    if result.fell:
        print(f"{controller} falls at {result.fall_time_s:.2f} s by {result.fall_cause}, after {result.first_limit}")
    else:
        least_mm = 1e3 * result.column("zmp_margin_m").min()
        print(f"{controller} stands; the ZMP came to within {least_mm:.1f} mm of the sole's edge")
