"""Stones: what the next one is like, where it would come up, and the ones that are there."""

from dataclasses import replace
from typing import Any

import viser

from surefoot.dashboard.messages.commands import (
    ClearStones,
    MoveStone,
    PlaceStone,
    PlaceStoneAtSole,
    RemoveStone,
    StoneKind,
)
from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.messages.stone_view import SOLE_PLACES, StoneView, place_on_sole, preview_of
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.sliders import add_slider, set_range
from surefoot.errors import InvalidInput
from surefoot.robot.description import RobotDescription
from surefoot.robot.feet import Support
from surefoot.simulation.stones import SHAPES, WEDGE, Stone

MM = 1e-3
NOWHERE, POINT = "nowhere", "a point"
_HEIGHT_MM, _SIZE_MM = 10, 60  # of the first stone, for Bip; others' as all below in proportion to the sole
_MOST_MM, _SIZES_MM, _SIZE_STEP_MM = 40, (20, 200), 5
_LEAST_SIZE_MM = 10  # that a stone may have
_EMPTY: tuple[str, ...] = ("no stones",)
_REACH_MM = 5000  # of the sliders; who clicks or drags reaches as far as the robot has walked

_HINTS = (
    "**Ctrl-click** the ground or a foot: stone at once. **Ctrl-shift-click**: see it there first. "
    "**Drag** a stone to move it. **Shift-drag** a link to pull it."
)


class StonesPanel(Panel):
    """What the next stone is like, and the ones that are there.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, self._send, self._places = context.gui, context.send_stone, tuple(SOLE_PLACES)
        gui.add_markdown(f"<small>{_HINTS}</small>")
        self._shape = gui.add_dropdown("Stone shape", SHAPES, hint="wedge: its top is a slope; half-ball: round on top")
        self._height = add_slider(
            gui,
            "Stone height [mm]",
            1,
            _MOST_MM,
            1,
            _HEIGHT_MM,
            hint="how far its highest point stands above the ground",
        )
        self._size = add_slider(
            gui, "Stone size [mm]", *_SIZES_MM, _SIZE_STEP_MM, _SIZE_MM, hint="its length and width"
        )
        self._slope = add_slider(gui, "Wedge slope [°]", 1, 30, 1, 10, hint="of its top", visible=False)
        self._towards = add_slider(
            gui,
            "Wedge rises to [°]",
            -180,
            180,
            15,
            90,
            hint="0 = forward, 90 = to the robot's left",
            visible=False,
            marks=((-90, "right"), (0, "front"), (90, "left")),
        )
        under = gui.add_button_group("Stone under", self._places, hint="place it under the sole that stands, at once")
        with gui.add_folder("See it first", expand_by_default=False):
            self._where = gui.add_dropdown(
                "Show it under", (NOWHERE, *self._places, POINT), hint="the orange stone: where the next one would be"
            )
            self._x = add_slider(gui, "Point x [mm]", -_REACH_MM, _REACH_MM, 5, 300, hint="forward", visible=False)
            self._y = add_slider(gui, "Point y [mm]", -_REACH_MM, _REACH_MM, 5, 110, hint="to the left", visible=False)
            there = gui.add_button("Place it there", hint="the orange stone becomes a real one")
        with gui.add_folder("Stones on the ground", expand_by_default=False):
            self._list = gui.add_dropdown("Stone", list(_EMPTY), hint="which one to move or to remove")
            self._move_x = add_slider(gui, "Stone x [mm]", -_REACH_MM, _REACH_MM, 5, 0, hint="move it forward")
            self._move_y = add_slider(gui, "Stone y [mm]", -_REACH_MM, _REACH_MM, 5, 0, hint="move it to the left")
            remove = gui.add_button_group("Take away", ("this one", "all"), hint="take stones away")
        self._stones: tuple[StoneView, ...] = ()
        self._robot: ShownRobot | None = None
        self._suit(context.newest().robot)

        @self._shape.on_update
        def _(_: viser.GuiEvent) -> None:
            self._slope.visible = self._towards.visible = self._shape.value == WEDGE

        @self._where.on_update
        def _(_: viser.GuiEvent) -> None:
            self._x.visible = self._y.visible = self._where.value == POINT

        under.on_click(lambda event: self._place_under(event.target.value))
        there.on_click(lambda _: self._place_there())
        remove.on_click(lambda event: self._remove(event.target.value))
        self._list.on_update(lambda event: self._chosen() if from_browser(event) else None)
        for slider in (self._move_x, self._move_y):
            slider.on_update(lambda event: self._shift() if from_browser(event) else None)

    def place_at(self, place: tuple[float, float]) -> None:
        """Place the next stone at a place of the world [m]."""
        self._send(PlaceStone(x_m=place[0], y_m=place[1], **self._kind()))

    def aim_at(self, place: tuple[float, float]) -> None:
        """Show where the next stone would be, at a place of the world [m]."""
        self._x.value, self._y.value = round(place[0] / MM), round(place[1] / MM)
        self._where.value = POINT
        self._x.visible = self._y.visible = True

    def wanted(self) -> tuple[str, Stone | None]:
        """Where the next stone should be shown: a place of the sole or one of the words above; and the stone.

        None while there is no such stone: somebody types, and a 6 is on its way to become a 60. Whoever places it
        nevertheless is told by the session.
        """
        kind = StoneKind(**self._kind())
        slope: dict[str, Any] = {"slope_deg": kind.slope_deg, "slope_direction_deg": kind.slope_direction_deg}
        try:
            stone = Stone(
                x_m=self._x.value * MM,
                y_m=self._y.value * MM,
                height_m=kind.height_m,
                size_m=(kind.size_m, kind.size_m),
                shape=kind.shape,
                **(slope if kind.shape == WEDGE else {}),
            )
        except InvalidInput:
            return self._where.value, None
        return self._where.value, stone

    def show(self, snapshot: Snapshot) -> None:
        """Take over which stones there are."""
        self._suit(snapshot.robot)
        stones = snapshot.geometry.stones
        if [_line(view) for view in stones] == [_line(view) for view in self._stones]:
            return
        self._stones = stones
        chosen = self._list.value.partition(":")[0]
        lines = tuple(_line(view) for view in stones) or _EMPTY
        kept = next((line for line in lines if line.partition(":")[0] == chosen), lines[-1])
        self._list.options = lines
        self._list.value = kept
        self._chosen()

    def _suit(self, robot: ShownRobot) -> None:
        """Stones of another robot go with its sole."""
        if self._robot is not None and robot.key == self._robot.key:
            return
        self._robot, step = robot, _SIZE_STEP_MM
        low, high, first = (max(_LEAST_SIZE_MM, step * round(robot.sole * mm / step)) for mm in (*_SIZES_MM, _SIZE_MM))
        set_range(self._height, 1.0, max(5, round(robot.sole * _MOST_MM)), 1.0)
        set_range(self._size, low, high, step)
        self._height.value, self._size.value = float(max(1, round(robot.width * _HEIGHT_MM))), float(first)

    def _kind(self) -> dict[str, Any]:
        return {
            "height_m": self._height.value * MM,
            "size_m": self._size.value * MM,
            "shape": self._shape.value,
            "slope_deg": float(self._slope.value),
            "slope_direction_deg": float(self._towards.value),
        }

    def _place_under(self, place: str) -> None:
        self._send(PlaceStoneAtSole(place=place, **self._kind()))

    def _place_there(self) -> None:
        where = self._where.value
        if where in self._places:
            self._place_under(where)
        elif where == POINT:
            self.place_at((self._x.value * MM, self._y.value * MM))

    def _selected(self) -> StoneView | None:
        return next((view for view in self._stones if _line(view) == self._list.value), None)

    def _chosen(self) -> None:
        if (view := self._selected()) is not None:
            self._move_x.value, self._move_y.value = (round(at / MM, 6) for at in (view.stone.x_m, view.stone.y_m))

    def _shift(self) -> None:
        if (view := self._selected()) is not None:
            self._send(MoveStone(number=view.number, x_m=self._move_x.value * MM, y_m=self._move_y.value * MM))

    def _remove(self, which: str) -> None:
        view = self._selected()
        if which == "all":
            self._send(ClearStones())
        elif view is not None:
            self._send(RemoveStone(view.number))


def _line(view: StoneView) -> str:
    stone = view.stone
    return (
        f"{view.number + 1}: {stone.shape} {stone.height_m / MM:.0f} mm at x {stone.x_m / MM:.0f}, "
        f"y {stone.y_m / MM:.0f} mm"
    )


def aimed_stone(where: str, stone: Stone | None, snapshot: Snapshot, robot: RobotDescription) -> StoneView | None:
    """What is to be shown of a stone that is not there yet; None when it should not be shown.

    Args:
        where: a place of the sole, or a word of the panel.
        stone: what it is like, and its place when that is a point of its own; None: no such stone.
        snapshot: how things stand.
        robot: whose soles.
    """
    if where == NOWHERE or stone is None:
        return None
    geometry = snapshot.geometry
    if where in SOLE_PLACES:
        index = Support(snapshot.support).reference_foot
        x, y, _ = place_on_sole(robot.feet[index], geometry.soles[index], where).tolist()
        stone = replace(stone, x_m=x, y_m=y)
    return preview_of(stone, geometry.ground_rotation, geometry.ground_pivot)
