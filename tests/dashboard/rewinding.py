"""What the tests of rewinding share: a live run that ticks, and what its world was, to the bit."""

from surefoot.dashboard.messages import commands as cmd


def bits(live):
    data = live.simulation.plant.data
    return live.simulation.time_s, data.qpos.tobytes(), data.qvel.tobytes(), data.ctrl.tobytes()


def ticks(live, count):
    """Tick on; what the world was after each."""
    seen = []
    for _ in range(count):
        live.tick()
        seen.append(bits(live))
    return seen


def first_difference(one, other):
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=True)) if a != b), None)


def texts(live, kind=None):
    return [event.text for event in live.log.events if kind in (None, event.kind)]


def eventful(live):
    """1.2 s in which a person does everything; what the world was after each tick."""
    seen = ticks(live, 160)
    live.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.006, size_m=0.06))
    seen += ticks(live, 210)
    live.apply(cmd.SetController("soft-qp"))
    seen += ticks(live, 20)
    live.apply(cmd.ChangeSettings({"com_stiffness": 70.0}))
    live.apply(cmd.SetFriction(0.6))
    seen += ticks(live, 180)
    live.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=4.0))
    seen += ticks(live, 300)
    live.apply(cmd.ClearStones())
    live.apply(cmd.SetController("two-part"))
    return seen + ticks(live, 330)
