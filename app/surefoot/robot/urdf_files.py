"""A URDF and the meshes that it names: ``package://``, ``model://``, ``file://`` or a path, and where those lie."""

import os
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

_PACKAGE_PATHS = (
    ("ROS_PACKAGE_PATH", ""),
    ("AMENT_PREFIX_PATH", "share"),
)  # variable, folder in its entries


def is_urdf(path: Path) -> bool:
    """Whether a file is a URDF, expanded or to be expanded by xacro: by its suffix, else by its first element."""
    if path.suffix.lower() in (".urdf", ".xacro"):
        return True
    try:
        _, element = next(ElementTree.iterparse(path, events=("start",)))
    except (OSError, ElementTree.ParseError, StopIteration):
        return False
    return element.tag == "robot"


def urdf_files(urdf: Path) -> dict[str, Path]:
    """The URDF and its meshes, also those that are only drawn: kind and name as the URDF has it -> file.

    A mesh that is not found is listed beside the URDF, where it is not; a file that is no XML is not looked into.
    """
    files = {"urdf": urdf}
    try:
        root = ElementTree.fromstring(urdf.read_bytes())
    except (OSError, ElementTree.ParseError):
        return files
    for mesh in root.iter("mesh"):
        name = mesh.get("filename", "")
        files[f"mesh {name}"] = find_mesh(urdf, name, mesh_folder(root)) or urdf.parent / name
    return files


def mesh_folder(root: Element) -> str:
    """What the URDF's ``<mujoco><compiler meshdir>`` says; empty: nothing."""
    compiler = root.find("mujoco/compiler")
    return "" if compiler is None else compiler.get("meshdir", "")


def find_mesh(urdf: Path, name: str, folder: str = "") -> Path | None:
    """The file that a URDF's mesh means; None: it is nowhere.

    Looked for in this order: where ``folder`` says; in the URDF's folder and each of its parents, the package as a
    folder there, as that folder, or under another name; below the folders that ROS_PACKAGE_PATH and AMENT_PREFIX_PATH
    list.

    Args:
        urdf: its file.
        name: as the URDF has it.
        folder: its ``meshdir``, as seen from the URDF; empty: none.
    """
    return next((place for place in _places(urdf.resolve(), name, folder) if place.is_file()), None)


def places_looked(urdf: Path) -> str:
    """Where meshes are looked for, in words."""
    listed = [f"{variable} ({os.environ.get(variable) or 'not set'})" for variable, _ in _PACKAGE_PATHS]
    return f"{urdf.resolve().parent} and its parent folders, {' and '.join(listed)}"


def _places(urdf: Path, name: str, folder: str) -> Iterator[Path]:
    scheme, _, rest = name.rpartition("://")
    if scheme == "file" or (not scheme and Path(name).is_absolute()):
        yield Path(rest)
        return
    parts = Path(rest.lstrip("/")).parts
    if not parts:
        return
    if folder:
        yield from (urdf.parent / folder / Path(*parts), urdf.parent / folder / parts[-1])
    package, inside = (parts[0], Path(*parts[1:])) if scheme else ("", Path(*parts))
    for parent in urdf.parents:
        yield parent / package / inside
        if parent.name == package:
            yield parent / inside
    if not package:
        return
    for variable, below in _PACKAGE_PATHS:
        for entry in filter(None, os.environ.get(variable, "").split(os.pathsep)):
            yield Path(entry) / below / package / inside
            if Path(entry).name == package:
                yield Path(entry) / inside
    yield from (parent / inside for parent in urdf.parents)  # a package that somebody's folder names otherwise
