"""What the tests of rewinding share: a run in which everything happens, and where two runs differ."""

from surefoot.dashboard.messages import commands as cmd
from tests.support.playback import recorded_ticks


def first_difference(one, other):
    """Index of the first difference of two lists of the same length; None when there is none."""
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=True)) if a != b), None)


def eventful(playback):
    """1.2 s in which a person does everything; what the world was after each tick."""
    seen = recorded_ticks(playback, 160)
    playback.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.006, size_m=0.06))
    seen += recorded_ticks(playback, 210)
    playback.apply(cmd.SetController("soft-qp"))
    seen += recorded_ticks(playback, 20)
    playback.apply(cmd.ChangeSettings({"com_stiffness": 70.0}))
    playback.apply(cmd.SetFriction(0.6))
    seen += recorded_ticks(playback, 180)
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=4.0))
    seen += recorded_ticks(playback, 300)
    playback.apply(cmd.ClearStones())
    playback.apply(cmd.SetController("two-part"))
    return seen + recorded_ticks(playback, 330)
