"""What a person does to Bip: pushes, pulls, friction, slope. Each returns its line for the log."""

from dataclasses import replace

from surefoot.dashboard.messages import commands as cmd
from surefoot.errors import InvalidInput
from surefoot.simulation.loop import Simulation
from surefoot.simulation.pulls import Pull
from surefoot.simulation.pushes import WHOLE_ROBOT, Push

MOST_HANDS = 8
CONFIRMED_FOR_S = 2.0  # simulated; a page confirms four times a second


def push_now(simulation: Simulation, command: cmd.PushNow) -> str:
    """A push that starts with the next tick. Raises InvalidInput."""
    links = (WHOLE_ROBOT, *simulation.robot.links)
    if command.link not in links:
        raise InvalidInput("push.link", command.link, "no such link", links)
    now = simulation.time_s
    push = Push(
        link=command.link, direction_deg=command.direction_deg, impulse_ns=command.impulse_ns, start_s=now,
        duration_s=command.duration_s,
    )  # fmt: skip
    simulation.pushes[:] = [*(p for p in simulation.pushes if p.start_s + p.duration_s > now), push]
    return f"push {push.impulse_ns:g} N s towards {push.direction_deg:.0f} deg in {push.duration_s:g} s"


def set_friction(simulation: Simulation, friction: float) -> str:
    """Friction of ground and stones from now on. Raises InvalidInput."""
    simulation.plant.change_physics(replace(simulation.plant.physics, friction=friction))
    return f"friction {friction:g}"


def hold_link(simulation: Simulation, command: cmd.HoldLink) -> str | None:
    """Pull a link from now on, or move the hand that does. Returns a line when it begins. Raises InvalidInput."""
    if command.link not in simulation.robot.links:
        raise InvalidInput("pull.link", command.link, "no such link", simulation.robot.links)
    now = simulation.time_s
    for who in [who for who, pull in simulation.pulls.items() if pull.until_s < now]:
        del simulation.pulls[who]
    began = command.who not in simulation.pulls
    if began and len(simulation.pulls) >= MOST_HANDS:
        raise InvalidInput("pull", command.who, "too many hands", [f"at most {MOST_HANDS} at a time"])
    simulation.pulls[command.who] = Pull(
        link=command.link, point=command.point, target=command.target, until_s=now + CONFIRMED_FOR_S
    )
    return f"pull at {command.link}" if began else None


def let_go(simulation: Simulation, who: str) -> str | None:
    """End a pull."""
    held = simulation.pulls.pop(who, None)
    return f"let go of {held.link}" if held else None


def tilt_ground(simulation: Simulation, command: cmd.TiltGround) -> str:
    """Turn the ground from however it lies. Raises InvalidInput."""
    simulation.plant.ground.tilt(simulation.time_s, command.slope_deg, command.direction_deg, command.duration_s)
    towards = f" that rises towards {command.direction_deg:.0f} deg" if command.slope_deg else ""
    return f"ground turns to a slope of {command.slope_deg:g} deg{towards} within {command.duration_s:g} s"
