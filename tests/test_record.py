"""Records are frozen by the type checker: it must know every one of them, and refuse what a frozen dataclass would."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest

APP = Path(__file__).resolve().parents[1] / "app" / "surefoot"


def records() -> dict[str, tuple[str, str]]:
    """Name of each record -> its module and its first field."""
    found = {}
    for file in sorted(APP.rglob("*.py")):
        module = ".".join(("surefoot", *file.relative_to(APP).with_suffix("").parts))
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef) and any("record" == _name(d) for d in node.decorator_list):
                field = next(part.target.id for part in node.body if isinstance(part, ast.AnnAssign))
                found[node.name] = module, field
    return found


def _name(decorator: ast.expr) -> str:
    target = decorator.func if isinstance(decorator, ast.Call) else decorator
    return target.id if isinstance(target, ast.Name) else ""


def test_the_type_checker_refuses_to_assign_to_any_field(tmp_path):
    pytest.importorskip("pyright")
    found = records()
    assert len(found) > 8, "the search for records finds too few"
    lines = [f"from {module} import {name}" for name, (module, _) in found.items()]
    first = len(lines)
    for name, (_, field) in found.items():
        lines.append(f"def change_{name.strip('_')}(one: {name}, other: {name}) -> None: one.{field} = other.{field}")
    (tmp_path / "assigning.py").write_text("\n".join(lines) + "\n")
    settings = {"extraPaths": [str(APP.parent)], "typeCheckingMode": "basic", "reportMissingModuleSource": "none"}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings))
    command = [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, "-p", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    report = json.loads(done.stdout)["generalDiagnostics"]
    refused = {item["range"]["start"]["line"] for item in report if item["rule"] == "reportAttributeAccessIssue"}
    assert refused == set(range(first, len(lines))), report


def test_a_record_has_only_its_fields():
    from surefoot.robot.sensing import FootSensing

    sensing = FootSensing(None)  # type: ignore[arg-type]
    with pytest.raises(AttributeError):
        sensing.somewhere_else = 1  # type: ignore[attr-defined]
