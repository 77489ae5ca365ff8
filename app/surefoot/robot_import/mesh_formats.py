"""Which mesh files MuJoCo decodes."""

from pathlib import Path

_DECODED = (".stl", ".obj", ".msh")
_STL_HEADER, _STL_FACE, _MOST_STL_FACES = 84, 50, 200_000  # bytes, bytes, MuJoCo's own bound


def not_decoded(path: Path) -> str | None:
    """Why MuJoCo does not decode a mesh file that is there; None: it does, as far as its size and suffix tell."""
    suffix = path.suffix.lower()
    if suffix not in _DECODED:
        return suffix or "no suffix"
    if suffix != ".stl":
        return None
    with path.open("rb") as file:
        faces = int.from_bytes(file.read(_STL_HEADER)[-4:], "little")
    if path.stat().st_size != _STL_HEADER + _STL_FACE * faces:
        return "ASCII STL"
    return None if 0 < faces <= _MOST_STL_FACES else f"STL of {faces} faces"
