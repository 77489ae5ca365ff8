"""One person's camera beside a robot that walks, knowing nothing of how cameras are told where to be."""

from collections import deque

import numpy as np

from surefoot.dashboard.scene.leash import Leash
from surefoot.dashboard.ui.mobile_layout import Place

SWAY_M = 0.2  # what a standing robot's centre of mass may do without moving the picture
_SHARE = 0.12  # of the way, in each frame: it starts and stops softly
_HANDS_OFF = 30  # frames: a person who moves the camera, or drags, is let finish
_SEEN_M = 1e-3  # less than a pixel, and more than the rounding with which a pose comes back from the browser
_REMEMBERED = 64  # poses: a second's; what was sent earlier has come back
_LOST = 60  # frames after which a camera that is still elsewhere is told again


class FollowingCamera:
    """Moves a camera and what it looks at by the same horizontal way as the robot went.

    A camera says where it is a little late. So it is not moved on from where it says to be, but from how the person
    last wanted it to stand to the robot; what it says is only compared with what it was told before. Anything else is
    the person's own doing, and from then on what the person wants.

    Attributes:
        follows: whether it does; its person's choice.
    """

    def __init__(self) -> None:
        self.follows = True
        self._leash = Leash(SWAY_M, _SHARE)
        self._told: deque[np.ndarray] = deque(maxlen=_REMEMBERED)
        self._wanted = np.zeros((2, 3))  # position and target, from the leash's point
        self._placed: tuple[np.ndarray, np.ndarray] | None = None  # pose, and what was wanted with it
        self._hands_off = self._elsewhere = 0
        self._restarted = False

    def set_follows(self, follows: bool, robot: np.ndarray) -> None:
        """Follow from now on, or no more; the picture stays as it is."""
        if follows and not self.follows and self._told:
            self._leash.settle(robot)
            self._want(self._told[-1])
        self.follows = follows

    def place(self, place: Place, robot: np.ndarray) -> np.ndarray:
        """Where to look from (2, 3): a place that was meant for a robot at the origin.

        Args:
            place: position and target [m].
            robot: where it is now (2,) in world [m].
        """
        self._leash.settle(robot)
        pose = np.array(place)
        pose[:, :2] += self._leash.point
        self._want(pose)
        self._placed, self._hands_off = (pose, self._wanted), 0
        return pose

    def update(self, robot: np.ndarray, says: np.ndarray, *, restarted: bool, dragging: bool) -> np.ndarray | None:
        """Where to put the camera now (2, 3); None where it can stay.

        Args:
            robot: where it is now (2,) in world [m].
            says: position and target as the camera last said (2, 3) [m].
            restarted: the robot was put to its start.
            dragging: the person drags something, over a ground that must not move away.
        """
        self._listen(says, dragging)
        self._restarted |= restarted
        if not self.follows or self._hands_off > 0:
            return None
        if self._restarted:
            self._leash.settle(robot)
        else:
            self._leash.follow(robot)
        self._restarted = False
        pose = self._wanted.copy()
        pose[:, :2] += self._leash.point
        self._elsewhere = 0 if _same(pose, says) else self._elsewhere + 1
        return None if _same(pose, self._told[-1]) and self._elsewhere < _LOST else pose

    def told(self, pose: np.ndarray) -> None:
        """The camera is being put there: it is not its person's doing when it says so."""
        self._told.append(pose)
        self._elsewhere = 0

    def has_returned(self, says: np.ndarray, first: np.ndarray) -> bool:
        """Whether it has gone, untold, to the page's first view: then it is to be placed beside the robot.

        A page goes there by itself once it has loaded, often seconds after it came, and at its person's "Reset View".

        Args:
            says: position and target as the camera last said (2, 3) [m].
            first: the page's first view (2, 3) [m], which was meant for a robot at the origin.
        """
        if not self._is_own(says):
            return False
        self._told = deque((pose for pose in self._told if not _same(pose, first)), maxlen=_REMEMBERED)
        if not _same(says, first):
            return False
        self.told(says)  # it goes on saying so until it has been placed
        return True

    def _is_own(self, says: np.ndarray) -> bool:
        return not any(_same(says, pose) for pose in reversed(self._told))

    def _listen(self, says: np.ndarray, dragging: bool) -> None:
        own = self._is_own(says)
        if own:
            self._want(says)
        elif self._placed is not None and _same(says, self._placed[0]):  # also when older movements came between
            self._wanted = self._placed[1]
        self._hands_off = _HANDS_OFF if own or dragging else max(0, self._hands_off - 1)

    def _want(self, pose: np.ndarray) -> None:
        """So it is to stand from now on, seen from where the leash's point is."""
        self._wanted = pose.copy()
        self._wanted[:, :2] -= self._leash.point
        self._told.append(pose.copy())


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    return bool(np.abs(one - other).max() < _SEEN_M)
