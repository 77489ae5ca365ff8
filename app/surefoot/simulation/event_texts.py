"""What is said of the things that happen in a run: the same words in the page's log and in a saved run."""

from surefoot.gait.footsteps import Footstep
from surefoot.simulation.external_forces import Push
from surefoot.simulation.falls import CONTROLLER_ERROR, ESTIMATOR_ERROR, FALL_CAUSES, LIMITS, fall_cause_text
from surefoot.simulation.loop import Simulation
from surefoot.simulation.stones import BOX, Stone
from surefoot.simulation.walk_causes import first_cause_text


def limit_text(name: str) -> str:
    """A limit was passed."""
    return f"{name}: {LIMITS[name]}"


def fall_text(simulation: Simulation) -> str:
    """Cause and time of a fall, the limit that went first on the way there, and what brought a walk down."""
    cause, sizes = simulation.fallen or "", simulation.robot.sizes
    meaning = fall_cause_text(cause, sizes) if cause in FALL_CAUSES else "unknown cause"
    first = simulation.watch.first
    before = f"; first limit passed: {first.name} at {first.time_s:.2f} s" if first else ""
    time_s, walk = simulation.fall_time_s or 0.0, simulation.fall_first
    began = f"; first cause: {walk.name} at {walk.time_s:.2f} s: {first_cause_text(walk.name, sizes)}" if walk else ""
    said = f": {simulation.error}" if cause in (CONTROLLER_ERROR, ESTIMATOR_ERROR) else ""
    return f"FALL at {time_s:.2f} s by {cause}: {meaning}{said}{before}{began}"


def step_text(step: Footstep, number: int, planned: int) -> str:
    """A foot has landed."""
    return f"step {number} of {planned}: the {('left', 'right')[step.foot]} foot has landed"


def push_text(push: Push) -> str:
    """A push begins."""
    return f"push {push.impulse_ns:g} N s towards {push.direction_deg:.0f} deg in {push.duration_s:g} s"


def tilt_text(slope_deg: float, direction_deg: float, duration_s: float) -> str:
    """The ground begins to turn."""
    towards = f" that rises towards {direction_deg:.0f} deg" if slope_deg else ""
    return f"ground turns to a slope of {slope_deg:g} deg{towards} within {duration_s:g} s"


def stone_name(stone: Stone) -> str:
    """What a stone is called."""
    return "stone" if stone.shape == BOX else stone.shape


def stone_text(stone: Stone, what: str) -> str:
    """A stone, and what it does."""
    length, width = (1e3 * size for size in stone.size_m)
    wide = f"{width:.0f} mm wide" if length == width else f"{length:.0f} by {width:.0f} mm wide"
    place = f"at x {stone.x_m:.3f}, y {stone.y_m:.3f} m"
    return f"{stone_name(stone)} {stone.height_m * 1e3:.0f} mm high, {wide} {place} {what}"
