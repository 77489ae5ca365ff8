"""A URDF as MuJoCo compiles it: its meshes found, what MuJoCo cannot decode left out and told.

The masses are those of ``<inertial>`` only, as everywhere in ROS: a link without one weighs nothing. MuJoCo's reader
makes ``effort`` the joint's ``actuatorfrcrange``, ``<dynamics>`` its damping and dry friction, ``<mimic>`` an equality.
"""

from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot.urdf_files import find_mesh, mesh_folder, places_looked
from surefoot.robot_import.mesh_formats import not_decoded
from surefoot.robot_import.urdf_inertia import joints_that_move_nothing, make_inertias_positive

_READ = ("link", "joint", "material", "mujoco")
_DRAWN_GROUP, _HIDDEN_GROUP = 2, 3
_NAMES_SHOWN = 6
_MISSED = {
    "velocity limits of joints": "joint[@type!='fixed']/limit[@velocity]",
    "soft limits of joints (<safety_controller>)": "joint/safety_controller",
    "<transmission>, with its reduction": "transmission",
    "<ros2_control>": "ros2_control",
    "<gazebo>": "gazebo",
}
_CONVERT = (
    "to have those shapes, convert them to binary STL or OBJ, e.g. with Python's trimesh (.dae: and pycollada): "
    "trimesh.load(FILE, force='mesh').export('x.stl'), and name those in the URDF"
)


@record
class UrdfModel:
    """What was read.

    Attributes:
        model: compiled.
        changed: what is other than in the file, one line each.
        left_out: what of the file is not in the model, one line each.
        idle_joints: names of the joints that move nothing that has mass.
    """

    model: mujoco.MjModel
    changed: tuple[str, ...]
    left_out: tuple[str, ...]
    idle_joints: tuple[str, ...]


def read_urdf(path: Path) -> UrdfModel:
    """Compile a URDF.

    Shapes that are drawn are in group 2; collision shapes in group 3, or, on a link with no other shape left, in 2.

    Raises:
        InvalidInput: it is no URDF, needs xacro, a collision mesh is nowhere, or MuJoCo does not read it.
    """
    root = _root(path)
    left_out = (*_left_out_elements(root), *_left_out_meshes(path, root))
    for child in [child for child in root if child.tag not in _READ]:
        root.remove(child)
    compiler = _compiler(root)
    try:
        idle, changed = joints_that_move_nothing(root), tuple(make_inertias_positive(root))
        spec = mujoco.MjSpec.from_string(tostring(root, encoding="unicode"))
        for mesh in spec.meshes if compiler.get("inertiafromgeom") == "false" else ():
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # a thin one has no volume, and none is needed
        _group_shapes(spec)
        return UrdfModel(spec.compile(), changed, left_out, idle)
    except (ValueError, mujoco.FatalError) as error:
        words = " ".join(str(error).split())
        raise InvalidInput("robot", str(path), f"is no URDF that MuJoCo reads: {words}") from None


def _root(path: Path) -> Element:
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InvalidInput("robot", str(path), f"cannot be read: {error.strerror or error}") from None
    if path.suffix.lower() == ".xacro":
        raise _needs_xacro(path)
    try:
        root = ElementTree.fromstring(content)
    except ElementTree.ParseError as error:
        if b"<xacro:" in content:  # whose prefix nothing declares
            raise _needs_xacro(path) from None
        raise InvalidInput("robot", str(path), f"is no XML: {error}") from None
    if root.tag != "robot":
        raise InvalidInput("robot", str(path), f"is no URDF: its first element is <{root.tag}>, not <robot>")
    if any("xacro}" in element.tag for element in root.iter()):
        raise _needs_xacro(path)
    parts = (element for kind in ("link", "joint") for part in root.findall(kind) for element in part.iter())
    if any("${" in value or "$(" in value for element in parts for value in element.attrib.values()):
        raise _needs_xacro(path)
    return root


def _needs_xacro(path: Path) -> InvalidInput:
    name = path.name.removesuffix(".xacro").removesuffix(".urdf")
    return InvalidInput("robot", str(path), f"must be expanded first: xacro {path} > {name}.urdf")


def _compiler(root: Element) -> Element:
    """MuJoCo's settings: those of the file, but for what is needed here."""
    extension = root.find("mujoco")
    extension = SubElement(root, "mujoco") if extension is None else extension
    compiler = extension.find("compiler")
    compiler = SubElement(extension, "compiler") if compiler is None else compiler
    for settled in ("meshdir", "assetdir"):
        compiler.attrib.pop(settled, None)
    compiler.attrib |= {"strippath": "false", "discardvisual": "false", "fusestatic": "false"}
    compiler.set("inertiafromgeom", compiler.get("inertiafromgeom", "false"))
    return compiler


def _left_out_meshes(path: Path, root: Element) -> Iterator[str]:
    """Set the whole path of each mesh; take out the shapes whose mesh cannot be had."""
    folder = mesh_folder(root)
    lost: dict[tuple[str, str], list[str]] = {}
    for link in root.findall("link"):
        for kind in ("visual", "collision"):
            for shape in link.findall(kind):
                mesh = shape.find("geometry/mesh")
                if mesh is None:
                    continue
                name = mesh.get("filename", "")
                file = find_mesh(path, name, folder)
                if reason := "not found" if file is None else not_decoded(file):
                    lost.setdefault((kind, reason), []).append(name)
                    link.remove(shape)
                mesh.set("filename", str(file))
    if missing := lost.get(("collision", "not found")):
        names = _some(missing)
        raise InvalidInput("robot", str(path), f"collision meshes are not found: {names}; looked in {_looked(path)}")
    for (kind, reason), names in lost.items():
        if reason == "not found":
            yield f"{kind} meshes not found: {_some(names)}; looked in {_looked(path)}"
        else:
            files = _some([Path(name).name for name in names])
            yield f"{kind} shapes that MuJoCo does not decode ({reason}): {files}"
    if any(reason != "not found" for _, reason in lost):
        yield _CONVERT


def _looked(path: Path) -> str:
    return f"{places_looked(path)}: say in ROS_PACKAGE_PATH where the packages lie"


def _some(names: list[str]) -> str:
    names = list(dict.fromkeys(names))
    more = f" and {len(names) - _NAMES_SHOWN} more" if len(names) > _NAMES_SHOWN else ""
    return f"{len(names)} ({', '.join(names[:_NAMES_SHOWN])}{more})"


def _left_out_elements(root: Element) -> Iterator[str]:
    """What a person could miss; cameras, plugins and the like of simulators and drivers too."""
    for what, where in _MISSED.items():
        if count := len(root.findall(where)):
            yield f"{what}: {count}"
    yield "rotor inertia: a URDF says none, and none is simulated"


def _group_shapes(spec: mujoco.MjSpec) -> None:
    for body in spec.bodies:
        has_visual = any(not geom.contype and not geom.conaffinity for geom in body.geoms)
        for geom in body.geoms:
            touching = geom.contype or geom.conaffinity
            geom.group = _HIDDEN_GROUP if touching and has_visual else _DRAWN_GROUP
