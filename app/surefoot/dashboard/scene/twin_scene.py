"""The second robot of a twin run: a translucent ghost over the first, or beside it with markers of its own."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import viser

from surefoot.dashboard.messages.commands import Command, PlaceStone
from surefoot.dashboard.messages.shown_robot import view_scale
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.scene.markers.believed import BelievedMarker
from surefoot.dashboard.scene.markers.markers import MARKERS, Markers
from surefoot.dashboard.scene.scene import WHOLE_ROBOT, SceneView
from surefoot.dashboard.scene.terrain import terrain_width_m
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.mobile_layout import Place
from surefoot.robot.description import RobotDescription
from surefoot.simulation.terrain import LEVEL, Terrain

ARRANGEMENTS = (GHOST, BESIDE) = ("ghost over the first", "side by side")
APART_M = 0.8  # at least: each robot's uneven ground is drawn below it, and the two do not overlap
_FROM_BOTH, _WIDE_M = np.array((2.75, 1.8, 0.8)), 0.9  # from where both are seen; of the two robots themselves
_OPACITY = {GHOST: 0.4, BESIDE: 1.0}
_GHOST_MARKS = ("zmp", "com")  # the others would lie on those of the first
_NAME_BESIDE_M, _NAME_TIMES_COM = 0.42, {GHOST: 1.5, BESIDE: 2.05}  # where the names stand, clear of the trunks


class TwinScene:
    """Robot, stones and markers of the twin, made when one is first seen; names of both.

    Args:
        server: where to draw.
        robot: whose shapes to draw.
        look_from: moves a person's camera to a place.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        robot: RobotDescription,
        look_from: Callable[[viser.ClientHandle, Place], None],
    ) -> None:
        self._server, self._robot, self._look_from = server, robot, look_from
        self._choice = GHOST
        self._scenes: dict[str, SceneView] = {}
        self._marks: Markers | None = None
        self._wanted = {marker.key: marker.shown_at_first for marker in MARKERS}
        self._seen = False
        self._terrain, self._apart_m = LEVEL, APART_M
        self._names = [
            server.scene.add_label(f"/name_{who}", "", visible=False, font_screen_scale=1.1)
            for who in ("first", "twin")
        ]

    def change_robot(self, robot: RobotDescription) -> None:
        """Draw another robot from now on; its shapes are made when they are first seen."""
        self._robot = robot
        for scene in self._scenes.values():
            scene.remove()
        self._scenes = {}
        if self._marks is not None:
            self._marks.change_robot(robot)

    def arrange(self, choice: str, client: viser.ClientHandle | None) -> None:
        """One of ``ARRANGEMENTS``; whoever asked looks from where both can be seen."""
        self._choice = choice
        if client is not None:
            self._look_from(
                client, _both_robots(self._apart_m / view_scale(self._robot)) if choice == BESIDE else WHOLE_ROBOT
            )

    @property
    def arrangement(self) -> str:
        """How the twin is shown: one of ``ARRANGEMENTS``."""
        return self._choice

    def show(self, key: str, visible: bool) -> None:
        """Show or hide one kind of marker."""
        self._wanted[key] = visible

    def placed(self, command: Command) -> Command:
        """A stone clicked at the twin beside the first robot is meant for the same place of both."""
        beside = self._seen and self._choice == BESIDE
        if isinstance(command, PlaceStone) and beside and command.y_m > 0.5 * self._apart_m:
            return replace(command, y_m=command.y_m - self._apart_m)
        return command

    def update(self, snapshot: Snapshot) -> None:
        """Move everything to where it is; hide it when there is no twin."""
        other, choice = snapshot.twin.other if snapshot.twin else None, self._choice
        if other is not None and other.robot.key != snapshot.robot.key:  # about to be another robot
            other = None
        self._seen = other is not None
        self._make_room_for(snapshot.terrain)
        for name, scene in self._scenes.items():
            scene.set_visible(self._seen and name == choice)
        if self._marks is not None:
            self._marks.set_visible(self._seen)
        for label in self._names:
            label.visible = self._seen
        if other is None:
            return
        # along the ground: beside the first on a slope to the side too
        left = snapshot.geometry.ground_rotation[:, 1].tolist() if choice == BESIDE else (0.0, 0.0, 0.0)
        offset = (self._apart_m * left[0], self._apart_m * left[1], self._apart_m * left[2])
        if choice not in self._scenes:
            self._scenes[choice] = SceneView(
                self._server,
                self._robot,
                prefix=f"/twin_{len(self._scenes)}",
                tint=palette.TWIN,
                opacity=_OPACITY[choice],
                ground=False,
                blocks=choice == BESIDE,
                believed=choice == BESIDE,  # a ghost of the ghost would be too much
            )
        marks = self._marks = self._marks or Markers(self._server, self._robot, prefix="/twin_marks")
        marks.move_to(offset)
        for key, wanted in self._wanted.items():
            marks.show(key, wanted and (choice == BESIDE or key in _GHOST_MARKS))
        marks.update(other.geometry)
        scene = self._scenes[choice]
        scene.move_to(offset)
        scene.show_terrain(other.terrain)
        scene.show_believed(self._wanted[BelievedMarker.key])
        scene.update(other.geometry)
        aside = _NAME_BESIDE_M * view_scale(self._robot) if choice == GHOST else 0.0
        self._name(0, "first", snapshot, np.zeros(3), aside)
        self._name(1, "twin", other, np.array(offset), -aside)

    def _make_room_for(self, terrain: Terrain) -> None:
        if terrain is not self._terrain:
            self._terrain, self._apart_m = terrain, max(APART_M, terrain_width_m(terrain))

    def _name(self, index: int, who: str, robot: Snapshot, offset: np.ndarray, aside_m: float) -> None:
        label, balance, com = self._names[index], robot.balance, robot.geometry.com
        fell = f": fell at {balance.fall_time_s:.2f} s" if balance.fall_time_s is not None else ""
        label.text = f"{who} · {robot.controller}{fell}"
        label.anchor = "bottom-center" if aside_m == 0.0 else "center-left" if aside_m > 0.0 else "center-right"
        if np.isfinite(com.sum()):
            place = com + offset + (0.0, aside_m, (_NAME_TIMES_COM[self._choice] - 1.0) * com[2])
            label.position = tuple(np.round(place, 2).tolist())


def _both_robots(apart_m: float) -> Place:
    """From where both are seen, the twin so far beside the first [m], were they Bip."""
    target = np.array((0.0, 0.5 * apart_m, 0.8))
    away = (apart_m + _WIDE_M) / (APART_M + _WIDE_M) * _FROM_BOTH
    return tuple((target + away).tolist()), tuple(target.tolist())
