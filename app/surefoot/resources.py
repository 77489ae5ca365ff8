"""Where the files that are not Python live: beside the package in a checkout, inside it once installed from a wheel."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def resource_folder(name: str) -> Path:
    """The folder ``robot_models`` or ``static``. Raises FileNotFoundError when the installation is incomplete."""
    for candidate in (_PACKAGE / "_data" / name, _PACKAGE.parents[1] / name):
        if candidate.is_dir():
            return candidate
    raise FileNotFoundError(f"folder {name!r} is neither beside nor inside {_PACKAGE}")


def help_text(name: str) -> str:
    """One text, markdown."""
    return (resource_folder("static") / "help" / f"{name}.md").read_text(encoding="utf-8")


def logo() -> str:
    """The logo, SVG."""
    return (resource_folder("static") / "logo.svg").read_text(encoding="utf-8").strip()
