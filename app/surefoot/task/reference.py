"""What the robot should do: a reference for kappa as a function of time, and the law that tracks it."""

import math
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from surefoot.dynamics.terms import COM, PELVIS, UPPER, DynamicsTerms
from surefoot.geometry.rotations import rotation_vector
from surefoot.robot.feet import Support


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaskReference:
    """A wanted kappa with its first two derivatives, and which feet are planned to stand.

    Attributes:
        support: planned contacts.
        position_com: (3,) in world [m].
        rotation_pelvis_to_world: (3, 3).
        position_ankles: left and right ankle centre (3,) in world [m].
        rotation_feet_to_world: left and right (3, 3).
        upper_rad: (n - 18,) of the joints that are in no leg.
        velocity: kappa_d' (n,).
        acceleration: kappa_d'' (n,).
        zmp_in_world: planned ZMP (2,) [m], if a planner has computed it.
        com_acceleration: G'' (3,) [m/s2] that a gait has decided, in place of the tracking law's.
    """

    support: Support
    position_com: np.ndarray
    rotation_pelvis_to_world: np.ndarray
    position_ankles: tuple[np.ndarray, np.ndarray]
    rotation_feet_to_world: tuple[np.ndarray, np.ndarray]
    upper_rad: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    zmp_in_world: np.ndarray | None = None
    com_acceleration: np.ndarray | None = None


class Reference(Protocol):
    """Anything that knows the wanted kappa at every time."""

    def at(self, time_s: float) -> TaskReference:
        """The reference at a time [s]."""
        ...


@dataclass(frozen=True)
class Hold:
    """Stay at one kappa for ever."""

    posture: TaskReference

    def at(self, time_s: float) -> TaskReference:
        """The posture, whatever the time."""
        return self.posture


@dataclass(frozen=True)
class Swing:
    """Move the CoM from rest to rest along one horizontal axis by a quintic, then stay there.

    Attributes:
        posture: where it starts.
        axis: 0 sagittal (positive = forward), 1 lateral (positive = left).
        amplitude_m: displacement.
        duration_s: time from rest to rest.
        start_s: when it starts.
    """

    posture: TaskReference
    axis: int
    amplitude_m: float
    duration_s: float
    start_s: float

    def at(self, time_s: float) -> TaskReference:
        """The posture with its CoM displaced, and the quintic's derivatives in kappa_d' and kappa_d''."""
        s, s_dot, s_ddot = quintic((time_s - self.start_s) / self.duration_s)
        position, velocity, acceleration = (
            a.copy()
            for a in (
                self.posture.position_com,
                self.posture.velocity,
                self.posture.acceleration,
            )
        )
        position[self.axis] += self.amplitude_m * s
        velocity[self.axis] += self.amplitude_m * s_dot / self.duration_s
        acceleration[self.axis] += self.amplitude_m * s_ddot / self.duration_s**2
        return replace(self.posture, position_com=position, velocity=velocity, acceleration=acceleration)


def quintic(phase: float) -> tuple[float, float, float]:
    """The quintic s(phase) from 0 to 1 at rest at both ends, with its first and second derivative by phase."""
    p = min(max(phase, 0.0), 1.0)
    if not math.isfinite(p) or p in (0.0, 1.0):
        return p, 0.0, 0.0
    return (
        p**3 * (10.0 + p * (-15.0 + 6.0 * p)),
        30.0 * p**2 * (1.0 - p) ** 2,
        60.0 * p * (1.0 - p) * (1.0 - 2.0 * p),
    )


def task_error(terms: DynamicsTerms, reference: TaskReference) -> np.ndarray:
    """e = kappa(q) - kappa_d (n,); orientations as the world rotation vector from the wanted to the actual one.

    Equation: (18)
    """
    e = np.empty(len(terms.output_velocity))
    e[COM] = terms.position_com_in_world - reference.position_com
    e[PELVIS] = rotation_vector(terms.rotation_pelvis_to_world.dot(reference.rotation_pelvis_to_world.T))
    row = 6
    for foot, position, rotation in zip(
        terms.feet, reference.position_ankles, reference.rotation_feet_to_world, strict=True
    ):
        e[row : row + 3] = foot.position_ankle_in_world - position
        e[row + 3 : row + 6] = rotation_vector(foot.rotation_foot_to_world.dot(rotation.T))
        row += 6
    e[UPPER] = terms.upper_rad - reference.upper_rad
    return e


def tracking_acceleration(
    terms: DynamicsTerms, reference: TaskReference, stiffness: np.ndarray, damping: np.ndarray
) -> np.ndarray:
    """The commanded kappa'' = v + kappa_d'' with v = -K_P e - K_D e'.

    Applied exactly, the error obeys e'' + K_D e' + K_P e = 0 and decays; the paper's "e'' = 0 gives asymptotic
    stability" (21) is a slip for this. q'' follows from (20): q'' = H^-1 (kappa'' - h).

    Equation: (19)-(21), (23)-(25)

    Args:
        terms: dynamics at the state; e' = H v - kappa_d'.
        reference: the wanted kappa.
        stiffness: diagonal of K_P (n,) [1/s2].
        damping: diagonal of K_D (n,) [1/s].

    Returns:
        kappa'' (n,) [m/s2, rad/s2].
    """
    error = task_error(terms, reference)
    error_rate = terms.output_velocity - reference.velocity
    return reference.acceleration - stiffness * error - damping * error_rate


def com_acceleration(terms: DynamicsTerms, acceleration: np.ndarray) -> np.ndarray:
    """a_G (3,) [m/s2] as the first three rows of kappa'' = H q'' + h: the mass-weighted mean of the links'.

    The paper prints (26) without the masses, and calls the third row kappa_2.

    Equation: (26), (27)
    """
    return terms.output_jacobian[COM].dot(acceleration) + terms.output_drift[COM]
