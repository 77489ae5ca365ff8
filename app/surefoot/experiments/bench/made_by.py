"""What made a finished bench, in words: the first lines of the page about it."""

from collections.abc import Mapping
from typing import Any

from surefoot.experiments.bench.ladders import BIP

_BISECTED = "each bisected to the largest level survived"


def made_by(manifest: Mapping[str, Any]) -> list[str]:
    """The first lines of the page: command, commit, versions, seeds, packages from outside, what surviving means."""
    asked, versions = manifest["arguments"], manifest["versions"]
    found = "every level played" if any(asked.get(name) for name in ("levels", "goals", "every_level")) else _BISECTED
    packages = ", ".join(f"{name} {version}" for name, version in sorted(versions.items()))
    of_others = []
    if (robot := robot_of(manifest)) != BIP:
        of_others = [f"Robot: {robot}, its files' SHA-256 `{manifest['robot']['sha256'][:16]}`.", ""]
    return [
        *of_others,
        f"Made by `{command_of(manifest)}` from commit `{str(manifest['commit'])[:12]}`; {manifest['cells']} cells, "
        f"{found}. {packages}.",
        "",
        seeds_text(manifest),
        "",
        *_plug_ins(manifest.get("plug_ins", {})),
        survived_text(manifest),
    ]


def robot_of(manifest: Mapping[str, Any]) -> str:
    """What its robot is called; older benches are all Bip's."""
    return manifest.get("robot", {"name": BIP})["name"]


def command_of(manifest: Mapping[str, Any]) -> str:
    """The command that made a bench."""
    asked = manifest["arguments"]
    command = [
        "surefoot bench",
        *(["--goals"] if asked.get("goals") else []),
        *([f"--robot {asked['robot']}"] if asked.get("robot", BIP) != BIP else []),
        *(["--quick"] if asked["quick"] else []),
        f"--controllers {asked['controllers']}",
        *([f"--families {','.join(asked['families'])}"] if asked["families"] else []),
        *([f"--levels {','.join(map(str, asked['levels']))}"] if asked.get("levels") else []),
        f"--seeds {asked['seeds']} --first-seed {asked['first_seed']}",
        *(["--vary-plant"] if asked.get("vary_plant") else []),
        *(["--every-level"] if asked.get("every_level") else []),
        *(f"--set {change}" for change in asked.get("changes", ())),
    ]
    return " ".join(command)


def survived_text(manifest: Mapping[str, Any]) -> str:
    """What surviving means."""
    return f"Survived means: {', '.join(f'{what} {value}' for what, value in manifest['survived'].items())}."


def seeds_text(manifest: Mapping[str, Any]) -> str:
    """Which seeds, and what each of them moves."""
    seeds = manifest["seeds"]
    sizes = ", ".join(_size(what, size) for what, size in manifest["variation"].items() if what != "plant")
    if seeds == [0]:
        return "Seed 0: each case as it was designed."
    return (
        f"Seed{'s' if len(seeds) > 1 else ''} {', '.join(map(str, seeds))}: each moves every case at random, the same "
        f"for all controllers, by at most {sizes} (seed 0 moves nothing)."
    )


def _size(what: str, size: float) -> str:
    quantity, _, unit = what.rpartition("_")
    return f"{size:g} {unit} in {quantity}"


def _plug_ins(found: Mapping[str, Mapping[str, Any]]) -> list[str]:
    lines = []
    for name, about in found.items():
        needs = "".join(f", {package} {version}" for package, version in about["requires"].items())
        lines += [f"From outside: `{name}` of {about['package']} {about['version']}{needs}.", ""]
    return lines
