"""``tsid``: an adapter for TSID, the C++ task-space inverse dynamics of the Pinocchio family.

TSID keeps its own Pinocchio model and builds and solves its own QP, so it needs q and v only (``terms.state`` has them
in Pinocchio's layout) and gives torques in the model's joint order, which is ours. Its tasks are the rows of kappa that
no contact holds, with the gains and weights of the other controllers, so that a comparison compares programs, not
tuning: it should decide much like ``soft-qp``.

What soft-qp has and this lacks: the capture guard, a fallback, and rows for motors and joint stops. TSID has such rows,
but its solver (eiquadprog) was seen never to return from a QP without a solution, and with them a falling robot's often
has none; without them there always was one. So torques are clipped, as the plant would do.
"""

import importlib
import warnings

import numpy as np

from surefoot.control.balance.contact_wrench import required_wrench
from surefoot.control.balance.support import support_geometry
from surefoot.control.interface import ControlOutput, Status
from surefoot.control.registry import ControllerEntry
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import COM, FOOT_ROWS, PELVIS, UPPER, DynamicsTerms
from surefoot.errors import InvalidInput
from surefoot.momentum.delta import delta_about, momentum_rate
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference

_FORCE_WEIGHT = 1e-5  # of the contact forces [1/N2 against 1/(m/s2)2]: enough to choose between equal ones
_LEAST_FORCE_N, _MOST_FORCE_N = 0.0, 1e4  # along a sole's normal
_NOWHERE, _TURN = np.zeros(3), slice(3, 6)


def import_tsid():
    """TSID, or one clear line. Raises InvalidInput."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # Boost.Python: a converter is registered twice
            return importlib.import_module("tsid")
    except ImportError as error:  # a wheel built for another Pinocchio fails here too, on a missing symbol
        reason = f"TSID cannot be imported ({error}); scripts/setup_tsid.sh makes an environment where it can"
        raise InvalidInput("controller", "tsid", reason) from None


class Problem:
    """TSID's objects for one set of stance feet. Nothing in them outlives a tick: every reference is set anew.

    Args:
        robot: the robot.
        settings: gains, weights, ``zmp_margin``, ``assumed_friction``, ``feedforward``.
        stance: indices of the feet planned to be in contact (0 left, 1 right).
    """

    def __init__(self, robot: RobotDescription, settings: ControllerSettings, stance: tuple[int, ...]):
        self._tsid = tsid = import_tsid()
        self._robot, self._settings, self.stance = robot, settings, stance
        self._stiffness, self._damping, self._weights = (
            settings.stiffness(robot.dofs),
            settings.damping(robot.dofs),
            settings.weights(robot.dofs),
        )
        # All that is made here is kept: TSID holds plain pointers to it
        self._wrapper = tsid.RobotWrapper(robot.pinocchio_model, tsid.FLOATING_BASE_SYSTEM, False)
        self._dynamics = tsid.InverseDynamicsFormulationAccForce("surefoot", self._wrapper, False)
        self._contacts = {i: self._contact(i) for i in stance}
        self._com = self._task(tsid.TaskComEquality("com", self._wrapper), COM, 3)
        pelvis = tsid.TaskSE3Equality("pelvis", self._wrapper, robot.links[0])
        pelvis.setMask(np.array((0.0, 0.0, 0.0, 1.0, 1.0, 1.0)))
        self._pelvis = self._task(pelvis, PELVIS, 6)
        lumbar = tsid.TaskJointPosture("lumbar", self._wrapper)
        lumbar.setMask(np.r_[np.zeros(len(robot.joints) - 3), np.ones(3)])
        self._lumbar = self._task(lumbar, UPPER, len(robot.joints))
        self._swing = {
            i: self._task(tsid.TaskSE3Equality(f"swing {i}", self._wrapper, robot.feet[i].body), FOOT_ROWS[i], 6)
            for i in {0, 1} - set(stance)
        }
        self._solver = tsid.SolverHQuadProgFast("qp")
        self._solver.resize(self._dynamics.nVar, self._dynamics.nEq, self._dynamics.nIn)

    def solve(self, state: RobotState) -> tuple[np.ndarray, np.ndarray] | None:
        """Torques (15,) [N m] and q'' (21,), or None where the QP has no solution."""
        data = self._dynamics.computeProblemData(state.time_s, state.q, state.v)
        solution = self._solver.solve(data)
        if solution.status != 0:
            return None
        return np.array(self._dynamics.getActuatorForces(solution)), np.array(self._dynamics.getAccelerations(solution))

    def aim(self, reference: TaskReference) -> None:
        """Tell the tasks what is wanted."""
        acceleration = reference.acceleration[COM].copy()
        if self._settings.feedforward != "acceleration":
            acceleration[:2] = 0.0
        self._com.setReference(self._sample(reference.position_com, reference.velocity[COM], acceleration))
        turn = (np.r_[_NOWHERE, rates[PELVIS]] for rates in (reference.velocity, reference.acceleration))
        self._pelvis.setReference(self._sample(_pose(_NOWHERE, reference.rotation_pelvis_to_world), *turn))
        legs = np.zeros(len(self._robot.joints) - 3)
        lumbar = (reference.upper_rad, reference.velocity[UPPER], reference.acceleration[UPPER])
        self._lumbar.setReference(self._sample(*(np.r_[legs, values] for values in lumbar)))
        for i in (0, 1):
            pose, rows = _pose(reference.position_ankles[i], reference.rotation_feet_to_world[i]), FOOT_ROWS[i]
            if i in self._swing:
                rates = reference.velocity[rows], reference.acceleration[rows]
                self._swing[i].setReference(self._sample(pose, *rates))
            else:
                self._contacts[i].setReference(self._tsid.vectorToSE3(pose))

    def _contact(self, foot: int):
        """A rigid 6-D contact at the corners of a sole, drawn in by ``zmp_margin``."""
        feet, settings = self._robot.feet[foot], self._settings
        corners = feet.corners_from_ankle.copy()
        corners[:, :2] = feet.sole.centroid + settings.zmp_margin * (corners[:, :2] - feet.sole.centroid)
        contact = self._tsid.Contact6d(
            f"stance {foot}", self._wrapper, feet.body, corners.T.copy(), np.array((0.0, 0.0, 1.0)),
            settings.assumed_friction, _LEAST_FORCE_N, _MOST_FORCE_N,
        )  # fmt: skip
        contact.setKp(np.zeros(6))  # it follows the ground, not a pose, as our own controllers' stance foot does
        contact.setKd(np.full(6, settings.stance_foot_damping))
        self._dynamics.addRigidContact(contact, _FORCE_WEIGHT)
        return contact

    def _task(self, task, rows: slice, size: int):
        """Add a motion task with the gains and the weight of its rows of kappa."""
        task.setKp(np.full(size, self._stiffness[rows][0]))
        task.setKd(np.full(size, self._damping[rows][0]))
        self._dynamics.addMotionTask(task, float(self._weights[rows][0]), 1, 0.0)
        return task

    def _sample(self, value: np.ndarray, rate: np.ndarray, second_rate: np.ndarray):
        sample = self._tsid.TrajectorySample(len(value), len(rate))
        sample.value(value)
        sample.derivative(rate)
        sample.second_derivative(second_rate)
        return sample


def _pose(position: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """(12,) as TSID wants a pose: position [m], then the rotation by columns."""
    return np.concatenate((position, rotation.ravel(order="F")))


class TSID:
    """CoM, pelvis orientation, swing foot and lumbar joints as weighted tasks over rigid foot contacts.

    Copies decide the same to the bit: TSID's objects remember nothing from tick to tick (its solver starts cold), so a
    copy leaves them out and makes them anew with its first tick.

    Args:
        robot: the robot.
        settings: see ``Problem``.

    Raises:
        InvalidInput: TSID cannot be imported.
    """

    def __init__(self, robot: RobotDescription, settings: ControllerSettings):
        import_tsid()
        self._robot, self._settings = robot, settings
        self.reset()

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """Forget TSID's problem; the next tick, which knows the stance, makes it anew."""
        self._problem: Problem | None = None
        self._held = np.zeros(len(self._robot.joints)) if last_torques is None else last_torques.copy()

    def __deepcopy__(self, memo: object) -> "TSID":
        """A controller that goes on as this one would, without TSID's objects."""
        twin = TSID(self._robot, self._settings)
        twin.reset(self._held)
        return twin

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Torques of one tick; the last ones where TSID's QP has no solution, and that is counted."""
        support = support_geometry(self._robot, terms, reference.support, sensing)
        if self._problem is None or self._problem.stance != support.stance:
            self._problem = Problem(self._robot, self._settings, support.stance)
        self._problem.aim(reference)
        solved = self._problem.solve(terms.state)
        if solved is None:
            return self._output(Status.HOLDING, np.full(2, np.nan), np.full(3, np.nan))
        torques, acceleration = solved
        limits = self._robot.torque_limits
        self._held = np.clip(torques, -limits, limits)
        rate = momentum_rate(terms, acceleration)
        zmp = support.to_world(required_wrench(terms, rate, support).zmp)
        return self._output(Status.SOLVED, zmp, delta_about(support.origin, terms.position_com_in_world, rate))

    def _output(self, status: Status, zmp: np.ndarray, delta: np.ndarray) -> ControlOutput:
        """TSID decides motion and forces at once: there is no ZMP that was wanted before the limits."""
        return ControlOutput(
            torques=self._held, status=status, zmp_wanted_in_world=np.full(2, np.nan), zmp_commanded_in_world=zmp,
            delta_commanded=delta, infeasible=status is not Status.SOLVED,
        )  # fmt: skip


entry = ControllerEntry(name="tsid", help="TSID's task-space inverse dynamics (an adapter; needs TSID)", build=TSID)
