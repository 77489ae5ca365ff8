"""ZMP and capture point of the steps ahead: the ZMP is led along straight pieces, the capture point stays bounded."""

import math

import numpy as np

from surefoot.record import record

NO_PLAN = np.empty((0, 4))  # as ``DCMPlan.ahead`` has it
_PARTS = (0.0, 0.2, 0.4, 0.6, 0.8)  # of each piece that ``ahead`` tells of
_WAITS_S = 0.2  # so far ``ahead`` tells of a plan that waits already: nobody knows until when


@record
class ZMPPiece:
    """The ZMP moves evenly along a straight line.

    Attributes:
        start, end: (2,) in world [m].
        duration_s: more than 0.
    """

    start: np.ndarray
    end: np.ndarray
    duration_s: float


class DCMPlan:
    """Where ZMP and capture point should be, over the time of all pieces; both rest at the last end.

    With the ZMP at p0 + r t the pendulum's xi' = omega (xi - p) has the bounded solution

        xi(t) = p(t) + r / omega + e^(-omega (D - t)) (xi(D) - p(D) - r / omega)

    so from the capture point wanted at the end of the last piece all others follow backwards.

    Args:
        pieces: in order, each beginning where the last one ends; at least one.
        omega: natural frequency [rad/s].
    """

    def __init__(self, pieces: list[ZMPPiece], omega: float) -> None:
        self._pieces, self._omega, self._waits_from_s = pieces, omega, math.inf
        xi = pieces[-1].end
        self._ends: list[np.ndarray] = [xi] * len(pieces)
        self._brake = xi
        for i in range(len(pieces) - 1, -1, -1):
            self._ends[i] = xi
            xi = self._xi(i, 0.0)

    def wait(self, from_s: float, brake: np.ndarray) -> None:
        """Let the ZMP stay elsewhere from a time on, and the capture point go on as a pendulum's.

        So it is while a foot is late: what stands has one sole to push from, wherever the plan would be by now.

        Args:
            from_s: since the plan's start [s].
            brake: the ZMP (2,) after that, in world [m].
        """
        self._waits_from_s, self._brake = from_s, brake

    def at(self, time_s: float) -> tuple[np.ndarray, np.ndarray]:
        """ZMP and capture point (2,) in world [m] at a time since the plan's start [s]."""
        from_s = self._waits_from_s
        if time_s <= from_s:
            return self._as_first_planned(time_s)
        _, xi = self._as_first_planned(from_s)
        return self._brake, self._brake + math.exp(self._omega * (time_s - from_s)) * (xi - self._brake)

    def ahead(self, time_s: float) -> np.ndarray:
        """ZMP and capture point from a time since the plan's start [s] to its end, for whoever draws them.

        A plan that waits by then is told for the next 0.2 s as it waits; before that, as if nothing will be late.

        Returns:
            (n, 4) x and y of either in world [m]: the ZMP goes straight from row to row, the capture point nearly so.
        """
        if time_s > self._waits_from_s:
            return np.array([np.concatenate(self.at(time_s + part * _WAITS_S)) for part in (*_PARTS, 1.0)])
        rows, rest = [], max(time_s, 0.0)
        for i, piece in enumerate(self._pieces):
            for part in _PARTS if rest < piece.duration_s else ():
                t = rest + part * (piece.duration_s - rest)
                zmp = piece.start + (t / piece.duration_s) * (piece.end - piece.start)
                rows.append((*zmp.tolist(), *self._xi(i, t).tolist()))
            rest = max(rest - piece.duration_s, 0.0)
        rows.append((*self._pieces[-1].end.tolist(), *self._ends[-1].tolist()))
        return np.array(rows)

    def _as_first_planned(self, time_s: float) -> tuple[np.ndarray, np.ndarray]:
        rest = max(time_s, 0.0)
        for i, piece in enumerate(self._pieces):
            if rest < piece.duration_s:
                return piece.start + (rest / piece.duration_s) * (piece.end - piece.start), self._xi(i, rest)
            rest -= piece.duration_s
        return self._pieces[-1].end, self._ends[-1]

    def _xi(self, i: int, t: float) -> np.ndarray:
        piece, omega = self._pieces[i], self._omega
        rate = (piece.end - piece.start) / piece.duration_s
        ahead = rate / omega
        left = piece.duration_s - t
        return piece.end - rate * left + ahead + math.exp(-omega * left) * (self._ends[i] - piece.end - ahead)
