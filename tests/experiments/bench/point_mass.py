"""Ground histories made by hand: a point mass with a flywheel on one foot, whose ledger is known."""

import numpy as np

from surefoot.experiments.bench.episode import GroundHistory
from surefoot.experiments.scenario.bounds import CaptureBound

DT = 0.001
GRAVITY = 9.81


def pushed_point_mass(
    bound: CaptureBound, impulse_ns: float, *, moment_nm: float = 0.0, hold_s: float = 0.3, slide_m: float = 0.0,
    begins_s: float = 0.0,
) -> GroundHistory:  # fmt: skip
    """By semi-implicit steps: pushed forward, kept on its edge, at rest at the end.

    Args:
        bound: mass, height, edge and duration of the push.
        impulse_ns: J.
        moment_nm: about G, while ``hold_s`` lasts.
        hold_s: from the push's start on.
        slide_m: the foot goes forward by so much while the push lasts.
        begins_s: when the push starts, which is when the history does.
    """
    h, m, omega = GRAVITY / bound.omega**2, bound.mass_kg, bound.omega
    x, v, rows = float(bound.com @ bound.direction), 0.0, []
    for i in range(4000):
        t = i * DT
        edge = bound.offset + slide_m * min(t / bound.duration_s, 1.0)
        xi = x + v / omega
        zmp = min(edge, xi + 2.0 * (xi - 0.02)) if t > 0.0 else x
        moment = moment_nm if t < hold_s else 0.0  # pitching forward brakes a forward fall
        force = m * omega**2 * (x - zmp) - moment / h
        push = impulse_ns / bound.duration_s if t < bound.duration_s - 1e-9 else 0.0
        rows.append((begins_s + t, x, v, force, moment, zmp, edge))
        v += DT * (force + push) / m
        x += DT * v
    t, x, v, force, moment, zmp, edge = np.array(rows).T
    zero = np.zeros_like(t)
    return GroundHistory(
        t, np.column_stack((x, zero, zero + h)), np.column_stack((v, zero, zero)),
        np.column_stack((force, zero, zero + m * GRAVITY)), np.column_stack((zero, moment, zero)),
        m * GRAVITY * np.column_stack((zmp, zero)), edge[:, None, None] * bound.normal[None, None, :],
    )  # fmt: skip
