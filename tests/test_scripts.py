"""The measuring scripts find what they measure: files move, and nobody runs these every day."""

import subprocess
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"


def test_the_tick_benchmark_measures_every_controller():
    command = [sys.executable, SCRIPTS / "benchmark_tick.py", "--ticks", "50", "--scenarios", "stand_left"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for controller in ("two-part", "two-part-literal", "soft-qp", "optimization", "inverse dynamics"):
        assert controller in done.stdout


def test_the_estimator_benchmark_measures_every_estimator_of_ours():
    command = [sys.executable, SCRIPTS / "benchmark_estimators.py", "--ticks", "250", "--scenarios", "stand_double"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for estimator in ("anchor", "invariant-ekf"):
        assert estimator in done.stdout
