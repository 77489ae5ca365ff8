"""Pushes, the slope of the ground, friction."""

import viser

from surefoot.dashboard.messages.commands import PushNow, SetFriction, TiltGround
from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.sliders import add_slider, scaled_range, set_range
from surefoot.dashboard.ui.synced_widget import SyncedWidget
from surefoot.field_metadata import range_of
from surefoot.simulation.physics import PhysicsSettings

_MS = 1e-3
_FIRST_NS, _MOST_NS = 20, 100  # of a push, for Bip; other robots' in proportion (``ShownRobot.push``)
_COMPASS = ((-90, "right"), (0, "front"), (90, "left"))


class DisturbPanel(Panel):
    """What a person can do to the robot besides stones.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        with gui.add_folder("Push"):
            self._direction = add_slider(
                gui,
                "Direction [°]",
                -180,
                180,
                5,
                90,
                hint="0 = forward, 90 = to the robot's left, 180 = backward",
                marks=_COMPASS,
            )
            self._impulse = add_slider(
                gui, "Impulse [N·s]", 1, _MOST_NS, 1, _FIRST_NS, hint="force times duration, through the CoM"
            )
            self._duration = add_slider(gui, "Duration [ms]", 10, 1000, 10, 100, hint="how long the push lasts")
            push = gui.add_button("Push now", hint="key: P")
        with gui.add_folder("Ground"):
            self._slope = add_slider(gui, "Slope [°]", 0, 15, 0.5, 3, hint="how steep the ground will be")
            self._towards = add_slider(
                gui,
                "Rises to [°]",
                -180,
                180,
                15,
                0,
                hint="0 = forward, 90 = to the robot's left, 180 = backward",
                marks=_COMPASS,
            )
            self._within = add_slider(gui, "Tilt within [s]", 0.1, 5, 0.1, 1, hint="how long the ground takes to turn")
            tilt = gui.add_button_group("Turn it", ("tilt", "level"), hint="while the robot stands on it")
            self._friction = add_slider(
                gui,
                "Friction μ [-]",
                *range_of(PhysicsSettings, "friction"),
                0.01,
                first.friction,
                hint="of ground and stones; the controller counts on its own value (Gains, Weights and solver)",
            )

        self._robot: ShownRobot | None = None
        self._suit(first.robot)
        push.on_click(lambda _: send(self._push()))
        gui.add_command("Push now", hotkey="P").on_trigger(lambda _: send(self._push()))

        @tilt.on_click
        def _(event: viser.GuiEvent) -> None:
            slope = float(self._slope.value) if event.target.value == "tilt" else 0.0
            send(
                TiltGround(
                    slope_deg=slope, direction_deg=float(self._towards.value), duration_s=float(self._within.value)
                )
            )

        self._follower = SyncedWidget(self._friction)

        @self._friction.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(SetFriction(float(event.target.value)))

    def show(self, snapshot: Snapshot) -> None:
        """Take over the friction active, and which robot it is."""
        self._suit(snapshot.robot)
        self._follower.show(snapshot.friction)

    def _suit(self, robot: ShownRobot) -> None:
        if self._robot is not None and robot.key == self._robot.key:
            return
        self._robot = robot
        _, most, step = scaled_range(1.0, _MOST_NS, 1.0, robot.push)
        set_range(self._impulse, step, max(10.0 * step, most), step)
        first = round(robot.push * _FIRST_NS, 0 if step == 1.0 else 1)
        self._impulse.value = max(step, first)

    def _push(self) -> PushNow:
        return PushNow(
            direction_deg=float(self._direction.value),
            impulse_ns=float(self._impulse.value),
            duration_s=self._duration.value * _MS,
        )
