"""Our readings of what the paper leaves open or has wrong, one by one; the text is in ``deviations.toml``."""

import tomllib
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path


@dataclass(frozen=True)
class Deviation:
    """One reading.

    Attributes:
        equations: the numbers it concerns; none for a gap between the equations.
        printed: what the paper says, or does not say.
        ours: what is implemented.
        switch: the setting that brings the paper's form back or changes the reading, if there is one.
    """

    equations: tuple[int, ...]
    printed: str
    ours: str
    switch: str = ""


@lru_cache(maxsize=1)
def deviations() -> tuple[Deviation, ...]:
    """All readings, in the order of the file."""
    text = Path(__file__).with_name("deviations.toml").read_text(encoding="utf-8")
    return tuple(
        Deviation(
            equations=tuple(entry["equations"]),
            printed=" ".join(entry["printed"].split()),
            ours=" ".join(entry["ours"].split()),
            switch=entry.get("switch", ""),
        )
        for entry in tomllib.loads(text)["deviation"]
    )
