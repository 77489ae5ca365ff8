"""Pushes, pulls, friction, slope. Each returns its line for the log, if it has one."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.observation.event_log import LogLine
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.errors import InvalidInput
from surefoot.simulation.event_texts import push_text, tilt_text
from surefoot.simulation.external_forces import WHOLE_ROBOT, Pull, Push

MOST_PULLS = 8
CONFIRMED_FOR_S = 2.0  # simulated; a page confirms four times a second


def push_now(live: LiveRun, command: cmd.PushNow) -> LogLine:
    """A push that starts with the next tick. Raises InvalidInput."""
    simulation = live.simulation
    links = (WHOLE_ROBOT, *simulation.robot.links)
    if command.link not in links:
        raise InvalidInput("push.link", command.link, "no such link", links)
    now = simulation.time_s
    push = Push(
        link=command.link,
        direction_deg=command.direction_deg,
        impulse_ns=command.impulse_ns,
        start_s=now,
        duration_s=command.duration_s,
    )
    simulation.pushes[:] = [*(p for p in simulation.pushes if not p.over_at(now)), push]
    return LogLine(EventKind.PUSH, push_text(push))


def set_friction(live: LiveRun, command: cmd.SetFriction) -> LogLine:
    """Friction of ground and stones from now on. Raises InvalidInput."""
    plant = live.simulation.plant
    plant.change_physics(replace(plant.physics, friction=command.friction))
    return LogLine(EventKind.RUN, f"friction {command.friction:g}", "friction")


def hold_link(live: LiveRun, command: cmd.HoldLink) -> LogLine | None:
    """Pull a link from now on, or move the hand that does. Returns a line when it begins. Raises InvalidInput."""
    simulation = live.simulation
    if command.link not in simulation.robot.links:
        raise InvalidInput("pull.link", command.link, "no such link", simulation.robot.links)
    now = simulation.time_s
    for client_id in [key for key, pull in simulation.pulls.items() if pull.until_s < now]:
        del simulation.pulls[client_id]
    began = command.client_id not in simulation.pulls
    if began and len(simulation.pulls) >= MOST_PULLS:
        raise InvalidInput("pull", command.client_id, "too many hands", [f"at most {MOST_PULLS} at a time"])
    simulation.pulls[command.client_id] = Pull(
        link=command.link,
        point=command.point,
        target=command.target,
        strength=simulation.robot.sizes.weight,
        until_s=now + CONFIRMED_FOR_S,
    )
    return LogLine(EventKind.PUSH, f"pull at {command.link}") if began else None


def let_go(live: LiveRun, command: cmd.LetGo) -> LogLine | None:
    """End a pull."""
    held = live.simulation.pulls.pop(command.client_id, None)
    return LogLine(EventKind.PUSH, f"let go of {held.link}") if held else None


def tilt_ground(live: LiveRun, command: cmd.TiltGround) -> LogLine:
    """Turn the ground from however it lies. Raises InvalidInput."""
    simulation = live.simulation
    simulation.plant.ground.tilt(simulation.time_s, command.slope_deg, command.direction_deg, command.duration_s)
    return LogLine(EventKind.RUN, tilt_text(command.slope_deg, command.direction_deg, command.duration_s))


HANDLERS: dict[type, Callable[[LiveRun, Any], LogLine | None]] = {
    cmd.PushNow: push_now,
    cmd.HoldLink: hold_link,
    cmd.LetGo: let_go,
    cmd.TiltGround: tilt_ground,
    cmd.SetFriction: set_friction,
}
