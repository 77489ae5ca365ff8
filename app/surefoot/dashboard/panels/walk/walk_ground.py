"""The ground of a walk as words of two menus, and what each word changes of a scenario."""

from collections.abc import Mapping
from typing import Any

Menu = Mapping[str, Mapping[str, Any]]  # word -> dotted paths and values, as ``--set`` takes them; first what is usual

TILES: Menu = {"none": {}, **{f"±{mm} mm": {"ground.tiles.amplitude_m": 1e-3 * mm} for mm in (10, 20, 30)}}
_DEG = 5.0
SLOPES: Menu = {
    "level": {},
    **{
        f"{_DEG:g}° {word}": {"ground.slope_deg": _DEG, **({"ground.direction_deg": towards} if towards else {})}
        for word, towards in {"up": 0.0, "down": 180.0, "up to the left": 90.0, "up to the right": -90.0}.items()
    },
}


def word_of(menu: Menu, changes: Mapping[str, Any]) -> str | None:
    """The word that says what was changed of a scenario, as far as the menu is about it; None where none does."""
    paths = {path for meaning in menu.values() for path in meaning}
    now = {path: value for path, value in changes.items() if path in paths}
    return next((word for word, meaning in menu.items() if meaning == now), None)
