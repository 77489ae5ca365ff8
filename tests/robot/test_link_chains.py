"""Chains of links from the base to each end."""

from surefoot.robot.description import load_robot


def test_a_biped_has_legs_trunk_and_arms():
    chains = load_robot("offset").link_chains
    assert {chain[-1] for chain in chains} == {"l_foot", "r_foot", "l_arm", "r_arm"}
    assert {chain[0] for chain in chains} == {"pelvis"}
    left = next(chain for chain in chains if chain[-1] == "l_foot")
    assert left == ("pelvis", "l_hip_yaw", "l_hip_roll", "l_thigh", "l_shank", "l_ankle", "l_foot")


def test_every_link_is_in_one(robot):
    assert {name for chain in robot.link_chains for name in chain} == set(robot.links)
