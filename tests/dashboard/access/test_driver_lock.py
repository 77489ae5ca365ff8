"""Who drives: rules of control, without a page."""

import pytest

from surefoot.dashboard.access.driver_lock import EVERYBODY, IDLE_S, ONE, DriverLock
from surefoot.dashboard.messages.commands import HoldLink, LetGo, Play, Reset
from surefoot.dashboard.panels.header.visitors import presence

ANN, BEN = 7, 9  # connections; they are visitors 1 and 2


class Hall:
    """A driver lock with a clock and a client to set by hand."""

    def __init__(self):
        self.now_s, self.current_client, self.sent, self.refused = 0.0, None, [], []
        self.driver_lock = DriverLock(self.sent.append, lambda: self.current_client, lambda: self.now_s)
        self.driver_lock.on_refusal = self.refused.append
        self.driver_lock.enter(ANN)
        self.driver_lock.enter(BEN)

    def send(self, who, command):
        """Whether it passed."""
        self.current_client, before = who, len(self.sent)
        self.driver_lock.send(command)
        return command in self.sent[before:]


@pytest.fixture
def hall():
    return Hall()


def pull(who):
    return HoldLink(client_id=str(who), link="trunk", point=(0.0, 0.0, 0.0), target=(0.0, 0.0, 1.0))


def test_at_first_everybody_drives(hall):
    assert hall.send(ANN, Play())
    assert hall.send(BEN, Play())
    assert hall.refused == []


def test_one_at_a_time_refuses_all_others_and_tells_them(hall):
    assert hall.driver_lock.set_mode(ANN, ONE)
    assert hall.send(ANN, Play())
    assert not hall.send(BEN, Reset())
    assert not hall.send(BEN, pull(BEN))
    assert hall.refused == [BEN, BEN]
    assert hall.send(None, Reset())  # the page's own


def test_a_pull_counts_as_its_owners_whoever_repeats_it(hall):
    hall.driver_lock.set_mode(ANN, ONE)
    assert hall.send(None, pull(ANN))
    assert not hall.send(None, pull(BEN))
    assert hall.send(BEN, LetGo(str(BEN)))


def test_only_the_driver_lets_everybody_drive_again(hall):
    hall.driver_lock.set_mode(ANN, ONE)
    assert not hall.driver_lock.set_mode(BEN, EVERYBODY)
    assert hall.driver_lock.view().mode == ONE
    assert hall.driver_lock.set_mode(ANN, EVERYBODY)
    assert hall.send(BEN, Play())


def test_control_changes_hands_when_the_driver_says_so(hall):
    hall.driver_lock.set_mode(ANN, ONE)
    assert not hall.driver_lock.request_control(BEN)
    assert hall.driver_lock.view().asking == 2
    hall.driver_lock.reply_to_request(BEN, hand_over=True)  # not his to give
    assert hall.driver_lock.view().driver == 1
    hall.driver_lock.reply_to_request(ANN, hand_over=False)
    assert (hall.driver_lock.view().driver, hall.driver_lock.view().asking) == (1, None)
    hall.driver_lock.request_control(BEN)
    hall.driver_lock.reply_to_request(ANN, hand_over=True)
    assert hall.driver_lock.view().driver == 2
    assert hall.sent[-1] == LetGo(str(ANN))  # nobody keeps a link in his hand
    assert not hall.send(ANN, Play())


def test_an_idle_driver_loses_it_to_who_asks_and_an_active_one_does_not(hall):
    hall.driver_lock.set_mode(ANN, ONE)
    hall.now_s = IDLE_S - 1.0
    hall.send(ANN, Play())
    hall.now_s += IDLE_S - 1.0
    assert not hall.driver_lock.request_control(BEN)
    assert not hall.driver_lock.grant_if_idle()
    hall.now_s += 1.0
    assert hall.driver_lock.grant_if_idle()
    assert hall.driver_lock.view().driver == 2
    hall.now_s += IDLE_S
    assert not hall.driver_lock.grant_if_idle()  # nobody asks
    assert hall.driver_lock.request_control(ANN)
    assert hall.driver_lock.view().driver == 1


def test_a_driver_who_leaves_lets_go_of_control_and_link(hall):
    hall.driver_lock.set_mode(ANN, ONE)
    hall.driver_lock.leave(ANN)
    assert hall.sent[-1] == LetGo(str(ANN))
    view = hall.driver_lock.view()
    assert (view.driver, view.visitors) == (None, {BEN: 2})
    assert hall.send(BEN, Play())  # who acts first has it
    assert hall.driver_lock.view().driver == 2


def test_a_driver_who_leaves_leaves_it_to_who_has_asked(hall):
    hall.driver_lock.set_mode(ANN, ONE)
    hall.driver_lock.request_control(BEN)
    hall.driver_lock.leave(ANN)
    assert hall.driver_lock.view().driver == 2


def test_numbers_are_small_and_used_again(hall):
    hall.driver_lock.leave(ANN)
    hall.driver_lock.enter(11)
    assert hall.driver_lock.view().visitors == {BEN: 2, 11: 1}


def test_presence_says_who_is_here_and_who_drives(hall):
    assert presence(hall.driver_lock.view(), BEN) == "2 visitors, you are 2: everybody drives"
    hall.driver_lock.set_mode(ANN, ONE)
    assert presence(hall.driver_lock.view(), BEN) == "2 visitors, you are 2: visitor 1 drives"
    assert presence(hall.driver_lock.view(), ANN) == "2 visitors, you are 1: you drive"
    hall.driver_lock.leave(ANN)
    assert presence(hall.driver_lock.view(), BEN) == "1 visitor: the next to act drives"
