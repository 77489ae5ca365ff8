"""What the tests of rewinding share: a stage that ticks, and what its world was, to the bit."""

from surefoot.dashboard.messages import commands as ask


def bits(stage):
    data = stage.simulation.plant.data
    return stage.simulation.time_s, data.qpos.tobytes(), data.qvel.tobytes(), data.ctrl.tobytes()


def ticks(stage, count):
    """Tick on; what the world was after each."""
    seen = []
    for _ in range(count):
        stage.tick()
        seen.append(bits(stage))
    return seen


def first_difference(one, other):
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=True)) if a != b), None)


def texts(stage, kind=None):
    return [event.text for event in stage.log.events if kind in (None, event.kind)]


def eventful(stage):
    """1.2 s in which a person does everything; what the world was after each tick."""
    seen = ticks(stage, 160)
    stage.apply(ask.PlaceStoneAtSole(place="outer edge", height_m=0.006, size_m=0.06))
    seen += ticks(stage, 210)
    stage.apply(ask.SetController("soft-qp"))
    seen += ticks(stage, 20)
    stage.apply(ask.ChangeSettings({"com_stiffness": 70.0}))
    stage.apply(ask.SetFriction(0.6))
    seen += ticks(stage, 180)
    stage.apply(ask.PushNow(direction_deg=90.0, impulse_ns=4.0))
    seen += ticks(stage, 300)
    stage.apply(ask.ClearStones())
    stage.apply(ask.SetController("two-part"))
    return seen + ticks(stage, 330)
