"""One evaluation of the rigid-body dynamics: one function, one order of Pinocchio calls, no hidden state."""

import numpy as np

from surefoot.dynamics.terms import COM, FOOT_ROWS, PELVIS, UPPER, DynamicsTerms, FootTerms
from surefoot.robot.description import BASE_DOFS, RobotDescription, RobotState
from surefoot.robot.feet import Foot
from surefoot.robot.pinocchio_library import pin

_WORLD_AXES = pin.LOCAL_WORLD_ALIGNED
_BASE = 1  # index of the free-flyer joint


def foot_frame_name(foot: Foot) -> str:
    """What the foot's frame is called in the model that ``with_foot_frames`` gives."""
    return foot.body if foot.is_body_frame else f"surefoot_{foot.side}_foot"


def with_foot_frames(robot: RobotDescription) -> pin.Model:
    """The robot's model; where a foot's frame is not its link's own, a copy that has it as a frame."""
    model = robot.pinocchio_model
    if all(foot.is_body_frame for foot in robot.feet):
        return model
    model = model.copy()
    for foot in robot.feet:
        body = model.getFrameId(foot.body)
        link = model.frames[body]
        placement = link.placement * pin.SE3(foot.rotation_in_body, foot.ankle_in_body)
        if not foot.is_body_frame:
            model.addFrame(pin.Frame(foot_frame_name(foot), link.parentJoint, body, placement, pin.FrameType.OP_FRAME))
    return model


class DynamicsModel:
    """Evaluates the dynamics of a robot.

    Args:
        robot: the description whose Pinocchio model is used.
        adaptable: a copy of that model, for ``move_com``.
    """

    def __init__(self, robot: RobotDescription, *, adaptable: bool = False):
        self.robot = robot
        self._model = with_foot_frames(robot).copy() if adaptable else with_foot_frames(robot)
        self._base_com = self._model.inertias[_BASE].lever.copy()
        self._data = self._model.createData()
        self._feet = tuple(self._model.getFrameId(foot_frame_name(foot)) for foot in robot.feet)
        self._zero = np.zeros(self._model.nv)
        self._mass = robot.mass_kg
        self._springs = np.array([joint.spring_nm_rad for joint in robot.joints])  # k [N m/rad]
        self._rest = np.array([joint.spring_rest_rad for joint in robot.joints])  # q0
        self._has_springs = bool(self._springs.any())
        self._upper = np.array(robot.upper, dtype=int) + 1  # in q
        template = np.zeros((robot.dofs, self._model.nv))
        template[UPPER, robot.upper] = np.eye(len(robot.upper))
        self._jacobian_template = template

    def evaluate(self, state: RobotState) -> DynamicsTerms:
        """All terms of (1) and of kappa (2) at a state.

        M q'' + bias = T u + C^T lambda, with bias = N q' + G, in it k (q - q0) of a joint with a spring (Bip: none);
        kappa'' = H q'' + h. kappa(q) = [CoM 3, pelvis orientation 3, left foot 6, right foot 6, joints that are in no
        leg (Bip: 3 lumbar)]; the orientations stay rotation matrices, their rows of H are world angular velocities, so
        that H is regular at every orientation. H is singular at (nearly) straight knees, which lie outside Bip's joint
        ranges.

        Equation: (1), (2)

        Args:
            state: configuration and velocity.

        Returns:
            The bundle; every array in it is its own copy.
        """
        model, data, q, v = self._model, self._data, state.q, state.v
        pin.computeAllTerms(model, data, q, v)
        # second pass with zero acceleration: what it leaves in the frames and in dhg is drift, nothing else
        pin.computeCentroidalMomentumTimeVariation(model, data, q, v, self._zero)
        drift_momentum = data.dhg.vector.copy()
        centroidal_map = data.Ag.copy()
        feet = (self._foot(self._feet[0], v), self._foot(self._feet[1], v))
        rotation_pelvis = data.oMi[_BASE].rotation.copy()

        bias = data.nle.copy()
        if self._has_springs:
            bias[BASE_DOFS:] += self._springs * (q[BASE_DOFS + 1 :] - self._rest)
        H = self._jacobian_template.copy()
        H[COM] = centroidal_map[:3] / self._mass
        H[PELVIS, 3:6] = rotation_pelvis
        h = np.zeros(len(v))
        h[COM] = drift_momentum[:3] / self._mass
        for rows, foot in zip(FOOT_ROWS, feet, strict=True):
            H[rows] = foot.jacobian
            h[rows] = foot.drift
        velocity = H.dot(v)
        return DynamicsTerms(
            state=state,
            mass_kg=self._mass,
            gravity=self.robot.gravity,
            mass_matrix=data.M.copy(),
            bias=bias,
            position_com_in_world=data.com[0].copy(),
            velocity_com_in_world=velocity[COM],
            centroidal_map=centroidal_map,
            centroidal_drift=drift_momentum,
            rotation_pelvis_to_world=rotation_pelvis,
            upper_rad=q.take(self._upper),
            feet=feet,
            output_jacobian=H,
            output_velocity=velocity,
            output_drift=h,
        )

    def move_com(self, by: np.ndarray) -> None:
        """Have the robot's CoM elsewhere than the description says: it is the base's own that moves, no mass changes.

        Args:
            by: (3,) from where the description has the robot's CoM to where it is now to be, base axes [m].
        """
        inertia = self._model.inertias[_BASE]
        inertia.lever = self._base_com + by * (self._mass / inertia.mass)
        self._model.inertias[_BASE] = inertia

    def integrate(self, q: np.ndarray, step: np.ndarray) -> np.ndarray:
        """The configuration (7 + joints,) reached from q by a tangent step (n,), on the manifold."""
        return pin.integrate(self._model, q, step)

    def neutral(self, pelvis_position: np.ndarray) -> np.ndarray:
        """Configuration (7 + joints,) with all joints at zero, upright, pelvis at a place (3,) [m]."""
        q = pin.neutral(self._model)
        q[:3] = pelvis_position
        return q

    @property
    def joints(self) -> slice:
        """The actuated part of a velocity vector."""
        return slice(BASE_DOFS, self._model.nv)

    def _foot(self, frame: int, v: np.ndarray) -> FootTerms:
        model, data = self._model, self._data
        placement = pin.updateFramePlacement(model, data, frame)
        jacobian = pin.getFrameJacobian(model, data, frame, _WORLD_AXES)
        return FootTerms(
            position_ankle_in_world=placement.translation.copy(),
            rotation_foot_to_world=placement.rotation.copy(),
            jacobian=jacobian,
            velocity=jacobian.dot(v),
            drift=pin.getFrameClassicalAcceleration(model, data, frame, _WORLD_AXES).vector,
        )
