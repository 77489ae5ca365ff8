"""Whether a controller, which may be someone else's code, gave what a tick can go on with."""

from typing import Any

import numpy as np

from surefoot.control.interface import ControlOutput, Status

_ABSURD_TORQUE_NM = 1e7  # no motor, no number to believe in: treated like a NaN
_NUMBERS = "fiu"  # kinds of NumPy's types
_FLAGS = (bool, np.bool_)


def output_fault(output: Any, joints: int) -> str | None:
    """What is wrong with what ``tick`` gave; None when it can be used.

    Torques must be believable numbers. ZMP and delta_P are for plots only: NaN where there is none is allowed.

    Args:
        output: what it gave.
        joints: how many torques are wanted.
    """
    if not isinstance(output, ControlOutput):
        return f"tick gave a {type(output).__name__}, not a ControlOutput"
    for name, size in (
        ("torques", joints),
        ("zmp_wanted_in_world", 2),
        ("zmp_commanded_in_world", 2),
        ("delta_commanded", 3),
    ):
        value: Any = getattr(output, name)
        if not isinstance(value, np.ndarray):
            return f"tick gave {name} as a {type(value).__name__}, not as an array of {size} numbers"
        if value.shape != (size,) or value.dtype.kind not in _NUMBERS:
            return f"tick gave {name} of shape {value.shape} and type {value.dtype}, not {size} numbers"
    if not isinstance(output.status, Status):
        return f"tick gave the status {output.status!r}, which is no Status"
    for name in ("guard_active", "guard_relaxed", "gate_active", "infeasible"):
        flag: Any = getattr(output, name)
        if not isinstance(flag, _FLAGS):
            return f"tick gave {name} as a {type(flag).__name__}, neither true nor false"
    torques = output.torques
    if not float(torques.dot(torques)) < _ABSURD_TORQUE_NM**2:  # so written, a NaN is caught too
        worst = float(torques[np.abs(torques).argmax()])  # of a NaN, argmax gives the place
        return f"tick gave torques that no motor has, {worst:g} N m among them"
    return None
