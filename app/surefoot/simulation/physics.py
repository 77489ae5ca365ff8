"""What the plant can differ in from what the controller believes."""

from dataclasses import dataclass

from surefoot.field_metadata import check_fields, number, switch


@dataclass(frozen=True, kw_only=True)
class PhysicsSettings:
    """Parameters of the plant; the controller keeps the nominal model. Validated at creation (InvalidInput)."""

    friction: float = number(0.9, 0.01, 2.0, "", "friction coefficient of ground and stones", step=0.05)
    mass_scale: float = number(1.0, 0.5, 1.5, "", "scales every mass and inertia of the plant", step=0.01)
    control_delay_s: float = number(0.0, 0.0, 0.02, "s", "torques reach the motors this much later", step=0.001)
    torque_limits: bool = switch(True, "motors saturate at the torque limits")

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "physics")


TIMESTEP_S = 0.001
CONTACT_SOLREF = (0.006, 1.0)  # time constant [s] and damping ratio of a contact: stiff, critically damped
IMPEDANCE_RATIO = 10.0  # friction against normal force: keeps a loaded foot from creeping
