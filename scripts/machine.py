"""What the whole machine did, from Linux's own counters: the measurements beside it print that."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class MachineTimes:
    """Ticks of all cores since the machine started; zeros where the system does not tell.

    Attributes:
        all: of any kind.
        busy: neither idle nor stolen.
        stolen: taken away by the machine's owner.
    """

    all: float = 0.0
    busy: float = 0.0
    stolen: float = 0.0

    def __sub__(self, before: "MachineTimes") -> "MachineTimes":
        """What was used since."""
        return MachineTimes(self.all - before.all, self.busy - before.busy, self.stolen - before.stolen)


def machine_times() -> MachineTimes:
    """Now."""
    try:
        line = Path("/proc/stat").read_text(encoding="ascii").splitlines()[0]
    except OSError:
        return MachineTimes()
    fields = [float(word) for word in line.split()[1:9]]
    idle, stolen = fields[3] + fields[4], fields[7]
    return MachineTimes(sum(fields), sum(fields) - idle - stolen, stolen)
