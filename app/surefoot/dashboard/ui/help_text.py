"""Texts out of ``static/help``."""

from surefoot.resources import resource_folder


def help_text(name: str) -> str:
    """One text, markdown."""
    return (resource_folder("static") / "help" / f"{name}.md").read_text(encoding="utf-8")


def logo() -> str:
    """The logo, SVG."""
    return (resource_folder("static") / "logo.svg").read_text(encoding="utf-8").strip()
