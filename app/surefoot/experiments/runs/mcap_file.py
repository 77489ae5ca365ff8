"""A saved run as MCAP for Foxglove: frames of the links, a scene of robot, ground, stones and forces, and the numbers.

Messages are JSON with Foxglove's own schema names, so that its panels know them without any setting: 3D shows ``/tf``
and ``/scene``, Plot the fields of ``/balance``, ``/torques``, ``/angles`` and, with an estimator, ``/estimate``, Log
``/events``.
Only this file knows mcap.
"""

import io
import json
from collections.abc import Iterator
from typing import Any

import numpy as np
from mcap.writer import CompressionType, Writer

from surefoot.dynamics.links import evaluate_links
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.mcap_scene import scene_entities, stamp, terrain_entity, transform
from surefoot.experiments.runs.saved_run import SavedRun
from surefoot.experiments.runs.saved_world import SavedWorld
from surefoot.experiments.scenario.robots import robot_named
from surefoot.robot.description import RobotDescription, RobotState

SCENE_EVERY_S = 0.02  # 50 pictures a second
NUMBERS_EVERY = 5  # ticks: 200 of each number a second; every tick is in the other formats
_TIME = {"type": "object", "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}}
_NUMBERS = {
    "/balance": ("com_", "zmp_", "capture_", "delta_", "force_", "external_force_", "ground_"),
    "/torques": ("torque_",),
    "/angles": ("angle_",),
    "/estimate": ("believed_", "dcm_error_", "dcm_sigma_", "orientation_", "position_error_"),  # with an estimator only
}


def mcap_bytes(run: SavedRun) -> bytes:
    """The MCAP file. Raises InvalidInput: columns are missing, or the manifest makes no sense."""
    file = io.BytesIO()
    writer = Writer(file, compression=CompressionType.ZSTD)
    writer.start(profile="", library="surefoot")
    writer.add_metadata("surefoot", {"manifest": json.dumps(run.manifest)})
    _write_numbers(writer, run)
    _write_scene(writer, run)
    _write_events(writer, run)
    writer.finish()
    return file.getvalue()


def _write_numbers(writer: Writer, run: SavedRun) -> None:
    """A message per topic; what is not a number is left out."""
    time_s = run.column("time_s")
    for topic, starts in _NUMBERS.items():
        picked = [(i, name) for i, name in enumerate(run.columns) if name.startswith(starts)]
        if not picked:
            continue
        channel = _channel(
            writer, topic, f"surefoot{topic.replace('/', '.')}", {n: {"type": "number"} for _, n in picked}
        )
        for row, now in zip(run.table[::NUMBERS_EVERY], time_s[::NUMBERS_EVERY].tolist(), strict=True):
            values = {name: round(float(row[i]), 9) for i, name in picked if np.isfinite(row[i])}
            _send(writer, channel, now, values)


def _write_scene(writer: Writer, run: SavedRun) -> None:
    robot = robot_named(str(run.manifest["robot"]))
    frames = _channel(
        writer,
        "/tf",
        "foxglove.FrameTransforms",
        {
            "transforms": {
                "type": "array",
                "items": {
                    "type": "object",
                    "properties": {
                        "timestamp": _TIME,
                        "parent_frame_id": {"type": "string"},
                        "child_frame_id": {"type": "string"},
                        "translation": {"type": "object"},
                        "rotation": {"type": "object"},
                    },
                },
            }
        },
    )
    scene = _channel(
        writer,
        "/scene",
        "foxglove.SceneUpdate",
        {
            "deletions": {"type": "array", "items": {"type": "object"}},
            "entities": {"type": "array", "items": {"type": "object"}},
        },
    )
    world, lies = SavedWorld(run), None
    for row, now, q in _postures(robot, run):
        places = _link_frames(robot, q, now)
        _send(writer, frames, now, {"transforms": [transform(now, name, *pose) for name, pose in places.items()]})
        entities = scene_entities(now, robot, places, world, row)
        if lies is None or (world.ground.rotation != lies).any():  # hundreds of blocks: only when they have moved
            lies = world.ground.rotation.copy()
            entities.append(terrain_entity(now, world))
        _send(writer, scene, now, {"deletions": [], "entities": entities})


def _write_events(writer: Writer, run: SavedRun) -> None:
    log = _channel(
        writer,
        "/events",
        "foxglove.Log",
        {
            "timestamp": _TIME,
            "level": {"type": "integer"},
            "message": {"type": "string"},
            "name": {"type": "string"},
        },
    )
    levels = {"fall": 5, "error": 4, "infeasible": 3, "limit": 3}
    for time_s, kind, text in run.manifest.get("events", []):
        values = {"timestamp": stamp(time_s), "level": levels.get(kind, 2), "message": text, "name": kind}
        _send(writer, log, float(time_s), values)


def _postures(robot: RobotDescription, run: SavedRun) -> Iterator[tuple[int, float, np.ndarray]]:
    """Row, time and configuration (22,) of every picture."""
    joints = [f"angle_{joint.name}_rad" for joint in robot.joints]
    names = (*(f"pelvis_{a}_m" for a in "xyz"), *(f"pelvis_q{a}" for a in "xyzw"), *joints)
    q, time_s = np.column_stack([run.column(name) for name in names]), run.column("time_s")
    due = -np.inf
    for row, (now, posture) in enumerate(zip(time_s.tolist(), q, strict=True)):
        if now >= due and np.isfinite(posture).all():
            due = now + SCENE_EVERY_S - 1e-6
            yield row, now, posture


def _link_frames(robot: RobotDescription, q: np.ndarray, time_s: float) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Link -> position of its centre of mass and rotation, in world."""
    motions = evaluate_links(robot, RobotState(q, np.zeros(len(q) - 1), time_s), np.zeros(len(q) - 1))
    return dict(zip(motions.names, zip(motions.position_com, motions.rotation_link_to_world, strict=True), strict=True))


def _channel(writer: Writer, topic: str, schema: str, properties: dict[str, Any]) -> int:
    text = json.dumps({"title": schema, "type": "object", "properties": properties}).encode()
    number = writer.register_schema(name=schema, encoding="jsonschema", data=text)
    return writer.register_channel(topic=topic, message_encoding="json", schema_id=number)


def _send(writer: Writer, channel: int, time_s: float, values: dict[str, Any]) -> None:
    if not np.isfinite(time_s):
        raise InvalidInput("time_s", time_s, "is no time")
    when = round(1e9 * time_s)
    text = json.dumps(values, allow_nan=False).encode()
    writer.add_message(channel_id=channel, log_time=when, publish_time=when, data=text)
