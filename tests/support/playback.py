"""A live run driven by hand: ticks, what its world is to the bit, and what its log says."""


def ticks(playback, count):
    """Tick on; the result of the last tick."""
    result = None
    for _ in range(count):
        result = playback.tick()
    return result


def bits(playback):
    """Time, and bytes of positions, velocities and motor torques."""
    data = playback.live.simulation.plant.data
    return playback.live.simulation.time_s, data.qpos.tobytes(), data.qvel.tobytes(), data.ctrl.tobytes()


def recorded_ticks(playback, count):
    """Tick on; the bits of the world after each."""
    seen = []
    for _ in range(count):
        playback.tick()
        seen.append(bits(playback))
    return seen


def texts(playback, kind=None):
    """The lines of the log, of one kind or all."""
    return [event.text for event in playback.live.log.events if kind in (None, event.kind)]
