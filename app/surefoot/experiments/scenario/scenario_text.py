"""A scenario as the text of its file."""

import json
from collections.abc import Mapping
from typing import Any


def scenario_text(table: Mapping[str, Any], comment: str = "") -> str:
    """The TOML file of a parsed scenario; numbers keep every bit."""
    lines = [f"# {line}" for line in comment.splitlines()]
    lines += [f"{key} = {_value(value)}" for key, value in table.items() if not (value is None or _is_table(value))]
    for key, value in table.items():
        if isinstance(value, Mapping):
            lines += ["", f"[{key}]", *_table_lines(value)]
        elif _is_table(value):
            for entry in value:
                lines += ["", f"[[{key}]]", *_table_lines(entry)]
    return "\n".join(lines) + "\n"


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping) or (isinstance(value, list) and any(isinstance(v, Mapping) for v in value))


def _table_lines(table: Mapping[str, Any]) -> list[str]:
    return [f"{key} = {_value(value)}" for key, value in table.items() if value is not None]


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(_value(v) for v in value)}]"
    if isinstance(value, Mapping):
        return f"{{ {', '.join(_table_lines(value))} }}"
    return repr(value)
