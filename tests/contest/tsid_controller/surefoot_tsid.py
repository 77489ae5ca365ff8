"""``tsid``: an adapter for TSID, the C++ task-space inverse dynamics of the Pinocchio family.

UNTESTED beyond its refusal: tsid 1.10.0 has a wheel, but the library below it (libtsid) comes as source only, so that
no pair of packages could be imported beside pin 4.1 where this was written. Written against TSID's documented Python
interface; single support only; read it as a map of what goes where, and expect to correct it when you can run it.

What an adapter has to bridge: TSID keeps its own Pinocchio model and solves its own QP, so it needs q and v only
(``terms.state``, Pinocchio's layout already) and gives torques in the model's joint order, which is ours. It takes its
gains from the same settings as the other controllers, so that a comparison compares laws, not tuning.
"""

import importlib

import numpy as np

from app.control.interface import ControlOutput, FootSensing, Status
from app.control.registry import ControllerEntry
from app.control.settings import ControllerSettings
from app.control.support import support_geometry
from app.dynamics.terms import COM, PELVIS, DynamicsTerms
from app.errors import InvalidInput
from app.momentum.delta import delta_about, momentum_rate
from app.robot.description import RobotDescription
from app.task.reference import TaskReference

_FORCE_WEIGHT = 1e-5
_LEAST_FORCE_N, _MOST_FORCE_N = 1.0, 5000.0


def import_tsid():
    """TSID, or one clear line. Raises InvalidInput."""
    try:
        return importlib.import_module("tsid")
    except ImportError as error:  # a wheel built for another Pinocchio fails here too, on a missing symbol
        reason = (
            f"TSID cannot be imported ({error}); its packages do not match every Pinocchio: "
            "pip install 'surefoot[tsid]'"
        )
        raise InvalidInput("controller", "tsid", reason) from None


class TSID:
    """CoM, pelvis orientation, swing foot and lumbar posture as weighted tasks over one 6-D foot contact.

    Args:
        robot: the robot.
        settings: gains, weights, ``assumed_friction``.

    Raises:
        InvalidInput: TSID cannot be imported.
    """

    def __init__(self, robot: RobotDescription, settings: ControllerSettings):
        self._tsid = import_tsid()
        self._robot, self._settings = robot, settings
        self.reset()

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """The formulation is made anew with the first tick, which knows the posture."""
        self._problem = None
        self._held = np.zeros(len(self._robot.joints)) if last_torques is None else last_torques

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Torques of one tick; the last ones where TSID's QP has no solution, and that is counted."""
        q, v = terms.state.q, terms.state.v
        if self._problem is None:
            self._build(terms, reference)
        self._samples(reference)
        data = self._problem.computeProblemData(terms.state.time_s, q, v)
        solution = self._solver.solve(data)
        solved = solution.status == 0
        if solved:
            self._held = np.array(self._problem.getActuatorForces(solution))
        acceleration = np.array(self._problem.getAccelerations(solution)) if solved else np.zeros(len(v))
        support = support_geometry(self._robot, terms, reference.support, sensing)
        zmp = support.origin[:2]
        return ControlOutput(
            torques=self._held, status=Status.SOLVED if solved else Status.HOLDING, zmp_wanted_in_world=zmp,
            zmp_commanded_in_world=zmp, infeasible=not solved,
            delta_commanded=delta_about(
                support.origin, terms.position_com_in_world, momentum_rate(terms, acceleration)
            ),
        )  # fmt: skip

    def _build(self, terms: DynamicsTerms, reference: TaskReference) -> None:
        tsid, robot = self._tsid, self._robot
        stiffness, damping, weights = (getattr(self._settings, name)() for name in ("stiffness", "damping", "weights"))
        model = robot.pinocchio_model
        wrapper = tsid.RobotWrapper(model, tsid.RootJointType.FREE_FLYER_ROOT_JOINT, False)
        problem = tsid.InverseDynamicsFormulationAccForce("surefoot", wrapper, False)
        problem.computeProblemData(terms.state.time_s, terms.state.q, terms.state.v)
        foot = robot.feet[reference.support.reference_foot]
        contact = tsid.Contact6d(
            "stance", wrapper, foot.body, foot.corners_from_ankle.T.copy(), np.array((0.0, 0.0, 1.0)),
            self._settings.assumed_friction, _LEAST_FORCE_N, _MOST_FORCE_N,
        )  # fmt: skip
        contact.setKp(np.zeros(6))  # compliant, as our own controllers' stance foot is
        contact.setKd(np.full(6, self._settings.stance_foot_damping))
        contact.setReference(wrapper.framePosition(problem.data(), model.getFrameId(foot.body)))
        problem.addRigidContact(contact, _FORCE_WEIGHT)
        self._com = tsid.TaskComEquality("com", wrapper)
        self._com.setKp(stiffness[COM])
        self._com.setKd(damping[COM])
        problem.addMotionTask(self._com, float(weights[COM][0]), 1, 0.0)
        self._pelvis = tsid.TaskSE3Equality("pelvis", wrapper, robot.links[0])
        self._pelvis.setMask(np.array((0.0, 0.0, 0.0, 1.0, 1.0, 1.0)))
        self._pelvis.setKp(np.full(6, stiffness[PELVIS][0]))
        self._pelvis.setKd(np.full(6, damping[PELVIS][0]))
        problem.addMotionTask(self._pelvis, float(weights[PELVIS][0]), 1, 0.0)
        posture = tsid.TaskJointPosture("posture", wrapper)  # swing leg and trunk keep the posture they start in
        posture.setKp(np.full(len(robot.joints), stiffness[COM][0]))
        posture.setKd(np.full(len(robot.joints), damping[COM][0]))
        posture.setReference(tsid.TrajectorySample(terms.state.q[7:].copy(), np.zeros(15), np.zeros(15)))
        problem.addMotionTask(posture, 1e-2 * float(weights[COM][0]), 1, 0.0)
        bounds = tsid.TaskActuationBounds("torques", wrapper)
        bounds.setBounds(-robot.torque_limits, robot.torque_limits)
        problem.addActuationTask(bounds, 1.0, 0, 0.0)
        self._solver = tsid.SolverHQuadProgFast("qp")
        self._solver.resize(problem.nVar, problem.nEq, problem.nIn)
        self._problem, self._posture = problem, posture

    def _samples(self, reference: TaskReference) -> None:
        tsid = self._tsid
        self._com.setReference(tsid.TrajectorySample(
            reference.position_com, reference.velocity[COM], reference.acceleration[COM]
        ))  # fmt: skip
        pose = np.concatenate((np.zeros(3), reference.rotation_pelvis_to_world.ravel(order="F")))
        self._pelvis.setReference(tsid.TrajectorySample(pose, np.zeros(6), np.zeros(6)))


entry = ControllerEntry(name="tsid", help="TSID's task-space inverse dynamics (an adapter; needs TSID)", build=TSID)
