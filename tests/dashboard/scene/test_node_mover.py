"""What stands still is not sent again; what moves is where it is to a fiftieth of a millimetre."""

import numpy as np
import pytest

from surefoot.dashboard.scene.node_mover import SEEN, NodeMover


class Node:
    """Counts how often it is moved."""

    def __init__(self):
        self.moved = 0

    def __setattr__(self, name, value):
        super().__setattr__(name, value if name == "moved" else np.array(value))
        if name != "moved":
            self.moved += 1


def test_a_slow_drift_is_followed_in_steps_too_small_to_see():
    mover, node = NodeMover(), Node()
    for i in range(1000):
        place = np.array([1e-6 * i, 0.0, 0.5])
        mover.set(node, "position", place)
        assert np.abs(node.position - place).max() <= SEEN
    assert node.moved == pytest.approx(1000 * 1e-6 / SEEN, rel=0.1)


def test_only_the_nodes_that_moved_are_placed_and_new_ones_always():
    mover, nodes = NodeMover(), [Node() for _ in range(3)]
    positions, quaternions = np.zeros((3, 3)), np.tile((1.0, 0.0, 0.0, 0.0), (3, 1))
    mover.place(nodes, positions, quaternions)
    assert [node.moved for node in nodes] == [2, 2, 2]
    mover.place(nodes, positions, quaternions)
    assert [node.moved for node in nodes] == [2, 2, 2]
    positions = positions + [(0.0, 0.0, 0.0), (0.0, 1e-3, 0.0), (0.0, 0.0, 0.0)]
    mover.place(nodes, positions, quaternions)
    assert [node.moved for node in nodes] == [2, 3, 2]
    assert nodes[1].position[1] == 1e-3
    others = [*nodes[:2], Node()]
    mover.place(others, positions, quaternions)
    assert [node.moved for node in others] == [4, 5, 2]


def test_an_array_of_another_length_is_always_set():
    mover, node = NodeMover(), Node()
    mover.set(node, "points", np.zeros((2, 3)))
    mover.set(node, "points", np.zeros((3, 3)))
    assert node.points.shape == (3, 3)
