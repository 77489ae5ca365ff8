"""A scenario: what stands where, what it should do, and what happens to it. Read from a TOML file.

``surefoot run --help`` and the README show the format; every table but the first three keys is optional.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.estimation.settings import EstimatorSettings
from surefoot.experiments.scenario.other_robot import in_proportion_to
from surefoot.experiments.scenario.own_ranges import check_own_ranges
from surefoot.experiments.scenario.reference_spec import (
    EVEN_STEPS,
    MOST_STEPS,
    FootstepSpec,
    ReferenceSpec,
    even_walk,
    walking_gains,
)
from surefoot.experiments.scenario.robots import check_robot, robot_named
from surefoot.experiments.scenario.uneven_ground import Ledge, StonesUnderSteps
from surefoot.field_metadata import check_fields, from_mapping, number
from surefoot.robot.description import RobotDescription, available_robots
from surefoot.robot.feet import Support
from surefoot.simulation.external_forces import WHOLE_ROBOT, Push
from surefoot.simulation.ground import Ground
from surefoot.simulation.model_error import ModelErrorSettings
from surefoot.simulation.motors import MotorSettings
from surefoot.simulation.physics import TIMESTEP_S, PhysicsSettings
from surefoot.simulation.sensors.settings import SensorSettings
from surefoot.simulation.stones import POOL_SIZE, Stone
from surefoot.text_files import file_content, text_of, toml_of

_COM_HEIGHTS_M = (0.5, 1.2)  # of Bip, other robots' in proportion


def com_heights_m(robot: RobotDescription) -> tuple[float, float]:
    """Least and greatest height of G [m] that may be asked for; which of these it can take, its posture says."""
    low, high = (round(height * robot.sizes.com_height, 3) for height in _COM_HEIGHTS_M)
    return low, high


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """Everything a run depends on but the controller's name. Validated in ``__post_init__`` (InvalidInput).

    Attributes:
        name: how it is called in summaries (the file's name).
        stones: positions relative to the point below the stance ankle (the left one in double support) at t = 0.
        controller: settings that differ from the controller's own defaults; of one that
            steps with ``walking_gains`` for what is not said.
    """

    name: str = "scenario"
    robot: str = "bip"
    support: Support = Support.LEFT
    duration_s: float = number(5.0, 0.001, 600.0, "s", "how long to simulate")
    com_height_m: float | None = None
    drop_height_m: float = number(0.0, 0.0, 0.05, "m", "released this far above the ground", step=0.005)
    reference: ReferenceSpec = field(default_factory=ReferenceSpec)
    footsteps: tuple[FootstepSpec, ...] = ()
    stones: tuple[Stone, ...] = ()
    stones_under_steps: StonesUnderSteps = field(default_factory=StonesUnderSteps)
    ledges: tuple[Ledge, ...] = ()
    pushes: tuple[Push, ...] = ()
    ground: Ground = field(default_factory=Ground)
    physics: PhysicsSettings = field(default_factory=PhysicsSettings)
    sensors: SensorSettings = field(default_factory=SensorSettings)
    estimator: EstimatorSettings = field(default_factory=EstimatorSettings)
    motors: MotorSettings = field(default_factory=MotorSettings)
    model_error: ModelErrorSettings = field(default_factory=ModelErrorSettings)
    controller: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check what spans several fields."""
        check_fields(self, "")
        height = self.com_height_m
        low, high = com_heights_m(self.robot_description())
        number_in_range = isinstance(height, int | float) and not isinstance(height, bool) and low <= height <= high
        if height is not None and not number_in_range:
            raise InvalidInput("com_height_m", self.com_height_m, "out of range", [f"{low} to {high} m"])
        if len(self.stones) > POOL_SIZE:
            raise InvalidInput("stones", len(self.stones), "too many", [f"at most {POOL_SIZE}"])
        self._check_walk()
        self._check_sizes()
        links = (WHOLE_ROBOT, *self.robot_description().links)
        for i, push in enumerate(self.pushes):
            if push.link not in links:
                raise InvalidInput(f"pushes.{i}.link", push.link, "no such link", links)

    def _check_walk(self) -> None:
        """What goes with a walk, and with no other reference."""
        spec = self.reference
        if spec.steps_at_all and isinstance(self.controller, Mapping):
            object.__setattr__(self, "controller", {**walking_gains(self.robot_description()), **self.controller})
        if spec.kind == "walk" and self.support is not Support.DOUBLE:
            raise InvalidInput("support", str(self.support), "a walk starts on two feet", [Support.DOUBLE])
        if len(self.footsteps) > MOST_STEPS:
            raise InvalidInput("footsteps", len(self.footsteps), "too many", [f"at most {MOST_STEPS}"])
        reason = f'there are no steps with reference.kind = "{spec.kind}"'
        if spec.kind != "walk" and self.footsteps:
            raise InvalidInput("footsteps", len(self.footsteps), reason, ['reference.kind = "walk"'])
        if spec.kind != "walk" and self.stones_under_steps.height_m > 0.0:
            height = self.stones_under_steps.height_m
            raise InvalidInput("stones_under_steps.height_m", height, reason, ["0", 'reference.kind = "walk"'])
        for name in EVEN_STEPS if self.footsteps else ():
            if getattr(spec, name) != getattr(ReferenceSpec, name):
                reason = "the footsteps say where the feet go: leave it out"
                raise InvalidInput(f"reference.{name}", getattr(spec, name), reason)

    def _check_sizes(self) -> None:
        """What this robot may be asked for; steps that nobody makes only where they are not as usual."""
        spec = self.reference
        unused = EVEN_STEPS if self.footsteps else ()
        if spec.kind != "walk":
            usual = ReferenceSpec()
            unused = [name for name in usual.__dataclass_fields__ if getattr(spec, name) == getattr(usual, name)]
        check_own_ranges(spec, "reference", self.robot, besides=unused)
        if self.ground.tiles is not None:
            check_own_ranges(self.ground.tiles, "ground.tiles", self.robot)

    @property
    def ticks(self) -> int:
        """How many ticks a run of its duration has, one at least."""
        return max(1, round(self.duration_s / TIMESTEP_S))

    def robot_description(self) -> RobotDescription:
        """The robot it names. Raises InvalidInput."""
        return robot_named(self.robot)


def shipped_scenarios() -> dict[str, Path]:
    """The scenario files that come with the program, by name."""
    folder = Path(__file__).parent / "shipped"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def load_scenario(path: str | Path, changes: Mapping[str, Any] | None = None, *, robot_files: bool = False) -> Scenario:
    """Read a scenario file, or a shipped scenario by its name.

    Args:
        path: a TOML file, or a name out of ``shipped_scenarios()``.
        changes: dotted path -> value, applied before anything is checked, e.g. ``stones.0.height_m``. With another
            robot, what the file says is taken in proportion to it; what the changes say, as they say it.
        robot_files: whether the robot may be the path of a file: not where a visitor of the page says it. Of a
            scenario file it starts in that file's folder, of a change in the working folder.

    Raises:
        InvalidInput: file missing or malformed, unknown key, value out of range.
    """
    shipped, field = shipped_scenarios(), "scenario file"
    file = shipped.get(str(path), Path(path))
    text = text_of(file_content(file, field, valid=shipped), field, str(path))
    table = toml_of(text, field, str(path))
    folder = Path() if "robot" in (changes or {}) else file.parent
    table = _for_robot(table, (changes or {}).get("robot"), file.parent, robot_files=robot_files)
    for key, value in (changes or {}).items():
        set_in_table(table, key, value)
    name = file.stem.encode(errors="replace").decode()  # it may be in bytes that no text can have
    return scenario_from_table(table, name, robot_files=robot_files, folder=folder)


def _for_robot(table: dict[str, Any], robot: object, folder: Path, *, robot_files: bool) -> dict[str, Any]:
    """The table, in proportion to the robot that is wanted in place of the one it was written for; InvalidInput."""
    if robot is None or "robot" not in table:
        return table
    written_for = check_robot(table["robot"], files=robot_files, folder=folder)
    wanted = check_robot(robot, files=robot_files, folder=Path())
    return table if wanted == written_for else in_proportion_to({**table, "robot": written_for}, wanted)


def scenario_from_table(
    table: Mapping[str, Any], name: str = "scenario", *, robot_files: bool = False, folder: Path = Path()
) -> Scenario:
    """Check a parsed scenario.

    Args:
        table: its keys.
        name: how it is called.
        robot_files: whether the robot may be the path of a file.
        folder: where that path starts, if it is not whole.

    Raises:
        InvalidInput: names the key.
    """
    known = [name for name in Scenario.__dataclass_fields__ if name != "name"]
    for key in table:
        if key not in known:
            raise InvalidInput(key, table[key], "unknown key", known)
    for key in ("robot", "support", "duration_s"):
        if key not in table:
            raise InvalidInput(key, None, "is missing", {"robot": available_robots(), "support": Support}.get(key, ()))
    robot = check_robot(table["robot"], files=robot_files, folder=folder)
    if table["support"] not in list(Support):
        raise InvalidInput("support", table["support"], "no such support", list(Support))
    return Scenario(
        name=name,
        robot=robot,
        support=Support(table["support"]),
        duration_s=table["duration_s"],
        com_height_m=table.get("com_height_m"),
        drop_height_m=table.get("drop_height_m", 0.0),
        reference=from_mapping(ReferenceSpec, _reference_table(table, robot), "reference"),
        footsteps=tuple(_entries(table, "footsteps", FootstepSpec)),
        stones=tuple(_entries(table, "stones", Stone)),
        stones_under_steps=from_mapping(StonesUnderSteps, _table(table, "stones_under_steps"), "stones_under_steps"),
        ledges=tuple(_entries(table, "ledges", Ledge)),
        pushes=tuple(_entries(table, "pushes", Push)),
        ground=from_mapping(Ground, _table(table, "ground"), "ground"),
        physics=from_mapping(PhysicsSettings, _table(table, "physics"), "physics"),
        sensors=from_mapping(SensorSettings, _table(table, "sensors"), "sensors"),
        estimator=from_mapping(EstimatorSettings, _table(table, "estimator"), "estimator"),
        motors=from_mapping(MotorSettings, _table(table, "motors"), "motors"),
        model_error=from_mapping(ModelErrorSettings, _table(table, "model_error"), "model_error"),
        controller=_table(table, "controller"),
    )


def _reference_table(table: Mapping[str, Any], robot: str) -> dict[str, Any]:
    """``[reference]``; a walk's sizes that it does not say are in proportion to the robot."""
    said = _table(table, "reference")
    sizes = even_walk(robot_named(robot)) if said.get("kind") == "walk" else {}
    given = EVEN_STEPS if table.get("footsteps") else ()
    return {**{name: size for name, size in sizes.items() if name not in given}, **said}


def parse_change(text: str) -> tuple[str, Any]:
    """``key=value`` as a dotted path and a TOML value (a bare word is a string). Raises InvalidInput."""
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise InvalidInput("--set", text, "must be key=value", ["controller.guard=false", "stones.0.height_m=0.012"])
    try:
        return key.strip(), tomllib.loads(f"value = {value}")["value"]
    except (ValueError, RecursionError):  # no TOML, or more digits or brackets than can be read
        return key.strip(), value.strip()


def set_in_table(table: dict[str, Any], path: str, value: Any) -> None:
    """Set one value by dotted path; a number indexes a list, one past its end appends. Raises InvalidInput."""
    *parents, last = path.split(".")
    place: Any = table
    for i, part in enumerate(parents):
        lists = i + 1 < len(path.split(".")) and path.split(".")[i + 1].isdecimal()
        place = _child(place, part, path, [] if lists else {})
    if isinstance(place, list):
        raise InvalidInput(path, value, "a list entry needs a key", [f"{path}.height_m"])
    if not isinstance(place, dict):
        raise InvalidInput(path, value, "is below a plain value")
    place[last] = value


def _child(place: Any, part: str, path: str, empty: Any) -> Any:
    if isinstance(place, list):
        if not part.isdecimal() or int(part) > len(place):
            raise InvalidInput(path, part, "no such entry", range(len(place) + 1))
        if int(part) == len(place):
            place.append({})
        return place[int(part)]
    if not isinstance(place, dict):
        raise InvalidInput(path, part, "is below a plain value")
    return place.setdefault(part, empty)


def _table(table: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = table.get(key, {})
    if not isinstance(value, dict):
        raise InvalidInput(key, value, f"must be a table, written [{key}]")
    return value


def _entries(table: Mapping[str, Any], key: str, cls: type) -> list[Any]:
    value = table.get(key, [])
    if not isinstance(value, list) or not all(isinstance(entry, dict) for entry in value):
        raise InvalidInput(key, value, f"must be a list of tables, each written [[{key}]]")
    entries = []
    for i, entry in enumerate(value):
        if "drops" in entry:
            raise InvalidInput(f"{key}.{i}.drops", entry["drops"], "is for the page only")
        try:
            entries.append(from_mapping(cls, entry, f"{key}.{i}"))
        except InvalidInput as error:  # a range error knows the field, not which entry
            field_name = error.field.split(".")[-1]
            raise InvalidInput(f"{key}.{i}.{field_name}", error.value, error.reason, error.valid) from None
    return entries
