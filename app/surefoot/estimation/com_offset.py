"""How far the CoM is from where it is believed, by what the feet feel: tilt, masses and lengths are never exact."""

import numpy as np

from surefoot.dynamics.model import DynamicsModel
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.rotations import cross, heading
from surefoot.momentum.zmp import centre_of_pressure, natural_frequency
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.sensing import FootSensing

# Chosen, not searched for. A push must not be taken for an offset: it shows by a velocity far above what offsets give
MOST_INNOVATION_M_S = 0.03
MOST_SHARE_OF_HEIGHT = 0.04  # of G's height: 35 mm for Bip, whose sole is 90 mm to either side
LEAST_LOAD_SHARE = 0.5  # of the weight on the feet, for them to say anything
AIR_SHARE = 0.05  # of the weight: a foot that carries less is in the air, and its sensor's bias far from the other one


class CoMOffset:
    """An observer on the linear pendulum, and the nominal robot with its CoM where that observer has it.

    With the ZMP p from the feet and a CoM that is believed e ahead of where it is, the pendulum's v' = omega^2 (c - p)
    comes out too large by omega^2 e. A second velocity w goes by that law and follows the believed one,
    w' = omega^2 (c + e - p) + 2 r (v - w); the offset goes by their difference, e' = r^2 / omega^2 (v - w). The errors
    of both die out as s^2 + 2 r s + r^2: twice with the rate r. A lasting push is an offset too, and rightly so: it is
    what the ZMP has to stand against. Angular momentum about G, which has no mean while a robot stands, is left out.

    The offset is moved into the base's own CoM, so that gravity, momentum and kappa tell of the same robot.

    Args:
        robot: the nominal robot.
        rate: r [1/s].

    Attributes:
        offset: (2,) from the nominal CoM to where it is, heading axes of the base [m].
        dynamics: of that robot; it holds nothing but the offset, which is set in every tick.
    """

    def __init__(self, robot: RobotDescription, rate: float):
        self._robot, self._rate = robot, rate
        self.dynamics = DynamicsModel(robot, adaptable=True)
        self.offset = np.zeros(2)
        self._velocity: np.ndarray | None = None
        self._last_s = 0.0

    def evaluate(self, state: RobotState, sensing: FootSensing) -> DynamicsTerms:
        """Dynamics at a believed state; what the feet feel there moves the offset of the next tick.

        Args:
            state: believed.
            sensing: of the feet.
        """
        self.dynamics.move_com(np.array((*self.offset, 0.0)))
        terms = self.dynamics.evaluate(state)
        self._learn(terms, sensing)
        return terms

    def _learn(self, terms: DynamicsTerms, sensing: FootSensing) -> None:
        com, velocity = terms.position_com_in_world, terms.velocity_com_in_world[:2]
        step_s, self._last_s = terms.state.time_s - self._last_s, terms.state.time_s
        sole = min(
            float(foot.point_below(now.position_ankle_in_world, now.rotation_foot_to_world)[2])
            for now, foot in zip(terms.feet, self._robot.feet, strict=True)
        )
        zmp = _zmp(terms, sensing, sole)
        if self._velocity is None or zmp is None:
            self._velocity = velocity.copy()
            return
        height = float(com[2]) - sole
        square = natural_frequency(height, terms.gravity) ** 2
        apart = velocity - self._velocity
        self._velocity = self._velocity + step_s * (square * (com[:2] - zmp) + 2.0 * self._rate * apart)
        innovation = np.clip(apart, -MOST_INNOVATION_M_S, MOST_INNOVATION_M_S)
        change = step_s * self._rate**2 / square * innovation.dot(heading(terms.rotation_pelvis_to_world))
        most = MOST_SHARE_OF_HEIGHT * height
        self.offset = np.clip(self.offset + change, -most, most)


def _zmp(terms: DynamicsTerms, sensing: FootSensing, height: float) -> np.ndarray | None:
    """(2,) of both feet together, in the plane of that height [m], world; None where they carry too little to tell."""
    force, moment, plane = np.zeros(3), np.zeros(3), np.array((0.0, 0.0, height))
    weight = terms.mass_kg * terms.gravity
    for now, wrench in zip(terms.feet, sensing.wrenches, strict=True):
        if wrench[2] < AIR_SHARE * weight:
            continue
        push = now.rotation_foot_to_world.dot(wrench[:3])
        force += push
        moment += now.rotation_foot_to_world.dot(wrench[3:]) + cross(now.position_ankle_in_world - plane, push)
    if force[2] < LEAST_LOAD_SHARE * weight:
        return None
    return centre_of_pressure(force, moment)
