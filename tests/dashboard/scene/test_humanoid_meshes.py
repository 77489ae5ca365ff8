"""Meshes of a robot of others on their way to the browser: few enough, and most of them where they are seen."""

import pytest

from surefoot.dashboard.scene.robot import link_glb, robot_model
from surefoot.experiments.scenario.robots import robot_named
from tests.support.humanoids import path_of

MOST_BYTES = 2_000_000


@pytest.mark.robots
def test_g1_is_sent_in_two_megabytes_and_its_trunk_is_finer_than_its_hands():
    model = robot_model(robot_named(str(path_of("g1"))))
    visible: dict[str, list[int]] = {}
    for geom in range(model.ngeom):
        if model.geom_group[geom] < 3:
            visible.setdefault(model.body(int(model.geom_bodyid[geom])).name, []).append(geom)
    sent = {link: len(link_glb(model, geoms)) for link, geoms in visible.items()}
    assert len(sent) == 30
    assert sum(sent.values()) < MOST_BYTES
    assert max(sent, key=lambda link: sent[link]) == "torso_link"
    assert sent["torso_link"] > 4 * sent["left_wrist_yaw_link"]
