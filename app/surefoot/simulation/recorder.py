"""What happened, tick by tick: one table of named columns, all of it or the last seconds."""

from collections.abc import Sequence

import numpy as np

from surefoot.control.interface import ControlOutput, Status
from surefoot.robot.description import RobotState
from surefoot.simulation.belief import Belief
from surefoot.simulation.external_forces import ActingForce
from surefoot.simulation.measurement import BalanceMeasurement

_STATUS_CODE = {status: float(code) for code, status in enumerate(Status)}

# Not in runs that were saved before the plant's own world was recorded
GROUND_COLUMNS = ("ground_slope_x_rad", "ground_slope_y_rad")  # angle, towards where the ground rises
# sum of pushes and pulls, and the point that it acts on (NaN where nothing acts); world
FORCE_COLUMNS = (*(f"external_force_{a}_n" for a in "xyz"), *(f"external_force_at_{a}_m" for a in "xyz"))

# Only in runs with an estimator: see ``Belief``
BELIEF_COLUMNS = (
    *(f"believed_com_{a}_m" for a in "xyz"),
    *(f"dcm_error_{a}_m" for a in "xy"),
    *(f"dcm_sigma_{a}_m" for a in "xy"),
    *(f"orientation_error_{a}_rad" for a in "xyz"),  # x and y: tilt, z: yaw
    *(f"orientation_sigma_{a}_rad" for a in "xyz"),
    *(f"position_error_{a}_m" for a in "xyz"),
)


def column_names(joints: Sequence[str], *, belief: bool = False) -> list[str]:
    """Names of all columns, units in them; of a run with an estimator its errors too."""
    return [
        "time_s",
        *(f"com_{a}_m" for a in "xyz"),
        *(f"com_ref_{a}_m" for a in "xyz"),
        *(f"com_velocity_{a}_mps" for a in "xyz"),
        "zmp_x_m",
        "zmp_y_m",
        "zmp_wanted_x_m",
        "zmp_wanted_y_m",
        "zmp_commanded_x_m",
        "zmp_commanded_y_m",
        "zmp_margin_m",
        "capture_x_m",
        "capture_y_m",
        *(f"delta_commanded_{a}_nm" for a in "xyz"),
        *(f"delta_measured_{a}_nm" for a in "xyz"),
        "force_left_n",
        "force_right_n",
        *(f"torque_{joint}_nm" for joint in joints),
        *(f"angle_{joint}_rad" for joint in joints),
        "status",
        "guard",
        "gate",
        *(f"pelvis_{a}_m" for a in "xyz"),
        *(f"pelvis_q{a}" for a in "xyzw"),  # unit quaternion, pelvis to world
        *GROUND_COLUMNS,
        *FORCE_COLUMNS,
        *(BELIEF_COLUMNS if belief else ()),
    ]


class Recorder:
    """A table of ticks.

    Args:
        joints: joint names.
        capacity: rows; when they are used up the oldest are overwritten.
        belief: whether an estimator's errors are recorded too.
    """

    def __init__(self, joints: Sequence[str], capacity: int, *, belief: bool = False):
        self.columns = column_names(joints, belief=belief)
        self._index = {name: i for i, name in enumerate(self.columns)}
        self._rows = np.full((capacity, len(self.columns)), np.nan)
        self._written = 0
        self._oldest = 0  # rows before this one have been overwritten, or were before the last clear

    def __len__(self) -> int:
        """Rows that can be read."""
        return self._written - self._oldest

    @property
    def written(self) -> int:
        """Rows written since the start, overwritten ones included."""
        return self._written

    def clear(self) -> None:
        """Forget everything."""
        self._written = self._oldest = 0

    def rewind(self, written: int) -> None:
        """Forget the rows after the first ``written`` ones; what was overwritten by them stays lost."""
        self._written = written
        self._oldest = min(self._oldest, written)

    def add(
        self,
        state: RobotState,
        com: np.ndarray,
        com_reference: np.ndarray,
        com_velocity: np.ndarray,
        capture: np.ndarray,
        output: ControlOutput,
        applied: np.ndarray,
        balance: BalanceMeasurement,
        delta_measured: np.ndarray,
        slope: np.ndarray,
        acting: ActingForce,
        belief: Belief | None = None,
    ) -> None:
        """Write one tick."""
        row = self._rows[self._written % len(self._rows)]
        np.concatenate(
            (
                (state.time_s,),
                com,
                com_reference,
                com_velocity,
                balance.zmp_in_world,
                output.zmp_wanted_in_world,
                output.zmp_commanded_in_world,
                (balance.zmp_margin,),
                capture,
                output.delta_commanded,
                delta_measured,
                balance.normal_forces,
                applied,
                state.q[7:],
                (_STATUS_CODE[output.status], output.guard_active, output.gate_active),
                state.q[:7],
                slope,
                acting.force,
                acting.point,
                *(() if belief is None else _belief_parts(belief)),
            ),
            out=row,
        )
        self._written += 1
        self._oldest = max(self._oldest, self._written - len(self._rows))

    def column(self, name: str) -> np.ndarray:
        """One column (n,), oldest first."""
        return self.table()[:, self._index[name]]

    def table(self) -> np.ndarray:
        """All rows (n, columns), oldest first: a copy."""
        return self.last(len(self))

    def last(self, rows: int) -> np.ndarray:
        """The last rows (<= rows, columns), oldest first: a copy of just those."""
        n = min(rows, len(self))
        picked = np.arange(self._written - n, self._written) % len(self._rows)
        return self._rows[picked]


def _belief_parts(belief: Belief) -> tuple[np.ndarray, ...]:
    """In the order of ``BELIEF_COLUMNS``."""
    return (
        belief.position_com,
        belief.dcm_error,
        belief.dcm_sigma,
        belief.orientation_error,
        belief.orientation_sigma,
        belief.position_error,
    )
