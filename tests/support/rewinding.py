"""What the tests of rewinding share: a live run that ticks, and what its world was, to the bit."""

from surefoot.dashboard.messages import commands as cmd


def bits(playback):
    data = playback.live.simulation.plant.data
    return playback.live.simulation.time_s, data.qpos.tobytes(), data.qvel.tobytes(), data.ctrl.tobytes()


def ticks(playback, count):
    """Tick on; what the world was after each."""
    seen = []
    for _ in range(count):
        playback.tick()
        seen.append(bits(playback))
    return seen


def first_difference(one, other):
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=True)) if a != b), None)


def texts(playback, kind=None):
    return [event.text for event in playback.live.log.events if kind in (None, event.kind)]


def eventful(playback):
    """1.2 s in which a person does everything; what the world was after each tick."""
    seen = ticks(playback, 160)
    playback.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.006, size_m=0.06))
    seen += ticks(playback, 210)
    playback.apply(cmd.SetController("soft-qp"))
    seen += ticks(playback, 20)
    playback.apply(cmd.ChangeSettings({"com_stiffness": 70.0}))
    playback.apply(cmd.SetFriction(0.6))
    seen += ticks(playback, 180)
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=4.0))
    seen += ticks(playback, 300)
    playback.apply(cmd.ClearStones())
    playback.apply(cmd.SetController("two-part"))
    return seen + ticks(playback, 330)
