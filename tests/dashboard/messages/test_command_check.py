"""A widget's value is whatever a browser sent: what is of another kind than its field is told, and changes nothing."""

import numpy as np
import pytest

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.command_check import check_command
from surefoot.errors import InvalidInput

NAN = float("nan")
GOOD = [
    cmd.SetSpeed(1),
    cmd.SetFriction(np.float64(0.5)),
    cmd.RemoveStone(3),
    cmd.Reset(play=False),
    cmd.HoldLink(client_id="a", link="trunk", point=(0.0, 0, 0.1), target=(1.0, 1.0, 1.0)),
    cmd.ChangeSettings({"guard": False, "com_stiffness": 60, "saturation": "clip"}),
    cmd.ClearStones(),
]
BAD = [
    (cmd.SetSpeed(NAN), "must be a number"),
    (cmd.SetSpeed(float("inf")), "must be a number"),
    (cmd.SetSpeed(True), "must be a number"),
    (cmd.SetFriction("ice"), "must be a number"),
    (cmd.SetFriction(None), "must be a number"),
    (cmd.RemoveStone(1.5), "must be a whole number"),
    (cmd.LoadScenario(3), "must be a text"),
    (cmd.LoadScenario("x" * 5000), "must be a text"),
    (cmd.Reset(play="yes"), "must be true or false"),
    (cmd.HoldLink(client_id="a", link="trunk", point=(0.0, NAN, 0.1), target=(1.0, 1.0, 1.0)), "must be 3 numbers"),
    (cmd.HoldLink(client_id="a", link="trunk", point=(0.0, 0.1), target=(1.0, 1.0, 1.0)), "must be 3 numbers"),
    (cmd.ChangeSettings([1]), "names with"),
    (cmd.ChangeSettings({3: 1.0}), "names with"),
    (cmd.ChangeSettings({"guard": [True]}), "names with"),
    (cmd.ChangeSettings({str(i): 1.0 for i in range(500)}), "names with"),
]


@pytest.mark.parametrize("command", GOOD, ids=repr)
def test_what_widgets_send_is_taken(command):
    check_command(command)


@pytest.mark.parametrize(("command", "reason"), BAD, ids=[f"{i}" for i in range(len(BAD))])
def test_what_is_of_another_kind_is_refused(command, reason):
    with pytest.raises(InvalidInput, match=reason) as refused:
        check_command(command)
    assert "\n" not in str(refused.value)
