"""The files that an MJCF file or a URDF is made of, and one SHA-256 of all that decide a robot's physics."""

import hashlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from surefoot.robot.urdf_files import is_urdf, urdf_files

_SHAPES = ("mesh", "hfield")  # inertia and contact may come from them; textures and skins are only drawn


def model_files(model: Path) -> dict[str, Path]:
    """What an MJCF file or a URDF reads: ``mjcf_files``, ``urdf_files``."""
    return urdf_files(model) if is_urdf(model) else mjcf_files(model)


def mjcf_files(mjcf: Path) -> dict[str, Path]:
    """What an MJCF file reads: itself, what it includes, its meshes and height fields, also those that are only drawn.

    A file that is not there, or no XML, is listed and not looked into: MuJoCo says so in its own words.

    Returns:
        Kind and name as the MJCF has it -> file; names and not places, so that a copy elsewhere has the same ones.
    """
    return dict(_files(mjcf, "mjcf", frozenset()))


def files_sha256(files: Mapping[str, Path]) -> str:
    """SHA-256 of names and contents, in the order of the names; a file that is not there counts as such."""
    digest = hashlib.sha256()
    for name in sorted(files):
        content = hashlib.sha256(files[name].read_bytes()).hexdigest() if files[name].is_file() else "missing"
        digest.update(f"{name}\0{content}\n".encode())
    return digest.hexdigest()


def _files(mjcf: Path, name: str, above: frozenset[Path]) -> Iterator[tuple[str, Path]]:
    """Of one model; ``above``: the models that this one is an asset of."""
    folder, shapes, strip = mjcf.parent, mjcf.parent, False
    yield name, mjcf
    included = dict.fromkeys(_included(mjcf, folder, frozenset({mjcf})))
    for file in included:
        yield f"include {file}", folder / file
    roots = [root for file in (mjcf, *(folder / file for file in included)) if (root := _root(file)) is not None]
    for compiler in (found for root in roots for found in root.iter("compiler")):
        strip = compiler.get("strippath", str(strip)).lower() == "true"
        if directory := compiler.get("meshdir", compiler.get("assetdir")):
            shapes = folder / directory
    for element in (asset for root in roots for assets in root.iter("asset") for asset in assets):
        file = element.get("file")
        if file and element.tag in _SHAPES:
            yield f"{element.tag} {file}", shapes / (Path(file).name if strip else file)
        if file and element.tag == "model" and folder / file not in above:
            for inner, path in _files(folder / file, f"model {file}", above | {mjcf}):
                yield (inner if path == folder / file else f"model {file}: {inner}"), path


def _included(mjcf: Path, folder: Path, above: frozenset[Path]) -> Iterator[str]:
    """Names of the files that a file includes, and those; all start at the folder of the first."""
    root = _root(mjcf)
    for element in () if root is None else root.iter("include"):
        file = element.get("file", "")
        if file and folder / file not in above:
            yield file
            yield from _included(folder / file, folder, above | {folder / file})


def _root(mjcf: Path) -> Element | None:
    try:
        return ElementTree.fromstring(mjcf.read_bytes())
    except (OSError, ElementTree.ParseError):
        return None
