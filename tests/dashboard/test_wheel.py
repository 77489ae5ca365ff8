"""Who drives: rules of the wheel, without a page."""

import pytest

from surefoot.dashboard.access.driver_lock import EVERYBODY, IDLE_S, ONE, Wheel
from surefoot.dashboard.messages.commands import HoldLink, LetGo, Play, Reset
from surefoot.dashboard.panels.header.visitors import presence

ANN, BEN = 7, 9  # connections; they are visitors 1 and 2


class Hall:
    """A wheel with a clock and a speaker to set by hand."""

    def __init__(self):
        self.now_s, self.speaker, self.sent, self.refused = 0.0, None, [], []
        self.wheel = Wheel(self.sent.append, lambda: self.speaker, lambda: self.now_s)
        self.wheel.on_refusal = self.refused.append
        self.wheel.enter(ANN)
        self.wheel.enter(BEN)

    def send(self, who, command):
        """Whether it passed."""
        self.speaker, before = who, len(self.sent)
        self.wheel.send(command)
        return command in self.sent[before:]


@pytest.fixture
def hall():
    return Hall()


def pull(who):
    return HoldLink(who=str(who), link="trunk", point=(0.0, 0.0, 0.0), target=(0.0, 0.0, 1.0))


def test_at_first_everybody_drives(hall):
    assert hall.send(ANN, Play())
    assert hall.send(BEN, Play())
    assert hall.refused == []


def test_one_at_a_time_refuses_all_others_and_tells_them(hall):
    assert hall.wheel.set_mode(ANN, ONE)
    assert hall.send(ANN, Play())
    assert not hall.send(BEN, Reset())
    assert not hall.send(BEN, pull(BEN))
    assert hall.refused == [BEN, BEN]
    assert hall.send(None, Reset())  # the page's own


def test_a_pull_counts_as_its_owners_whoever_repeats_it(hall):
    hall.wheel.set_mode(ANN, ONE)
    assert hall.send(None, pull(ANN))
    assert not hall.send(None, pull(BEN))
    assert hall.send(BEN, LetGo(str(BEN)))


def test_only_the_driver_lets_everybody_drive_again(hall):
    hall.wheel.set_mode(ANN, ONE)
    assert not hall.wheel.set_mode(BEN, EVERYBODY)
    assert hall.wheel.view().mode == ONE
    assert hall.wheel.set_mode(ANN, EVERYBODY)
    assert hall.send(BEN, Play())


def test_the_wheel_changes_hands_when_the_driver_says_so(hall):
    hall.wheel.set_mode(ANN, ONE)
    assert not hall.wheel.ask(BEN)
    assert hall.wheel.view().asking == 2
    hall.wheel.answer(BEN, hand_over=True)  # not his to give
    assert hall.wheel.view().driver == 1
    hall.wheel.answer(ANN, hand_over=False)
    assert (hall.wheel.view().driver, hall.wheel.view().asking) == (1, None)
    hall.wheel.ask(BEN)
    hall.wheel.answer(ANN, hand_over=True)
    assert hall.wheel.view().driver == 2
    assert hall.sent[-1] == LetGo(str(ANN))  # nobody keeps a link in his hand
    assert not hall.send(ANN, Play())


def test_an_idle_driver_loses_it_to_who_asks_and_an_active_one_does_not(hall):
    hall.wheel.set_mode(ANN, ONE)
    hall.now_s = IDLE_S - 1.0
    hall.send(ANN, Play())
    hall.now_s += IDLE_S - 1.0
    assert not hall.wheel.ask(BEN)
    assert not hall.wheel.settle()
    hall.now_s += 1.0
    assert hall.wheel.settle()
    assert hall.wheel.view().driver == 2
    hall.now_s += IDLE_S
    assert not hall.wheel.settle()  # nobody asks
    assert hall.wheel.ask(ANN)
    assert hall.wheel.view().driver == 1


def test_a_driver_who_leaves_lets_go_of_wheel_and_link(hall):
    hall.wheel.set_mode(ANN, ONE)
    hall.wheel.leave(ANN)
    assert hall.sent[-1] == LetGo(str(ANN))
    view = hall.wheel.view()
    assert (view.driver, view.visitors) == (None, {BEN: 2})
    assert hall.send(BEN, Play())  # who acts first has it
    assert hall.wheel.view().driver == 2


def test_a_driver_who_leaves_leaves_it_to_who_has_asked(hall):
    hall.wheel.set_mode(ANN, ONE)
    hall.wheel.ask(BEN)
    hall.wheel.leave(ANN)
    assert hall.wheel.view().driver == 2


def test_numbers_are_small_and_used_again(hall):
    hall.wheel.leave(ANN)
    hall.wheel.enter(11)
    assert hall.wheel.view().visitors == {BEN: 2, 11: 1}


def test_presence_says_who_is_here_and_who_drives(hall):
    assert presence(hall.wheel.view(), BEN) == "2 visitors, you are 2: everybody drives"
    hall.wheel.set_mode(ANN, ONE)
    assert presence(hall.wheel.view(), BEN) == "2 visitors, you are 2: visitor 1 drives"
    assert presence(hall.wheel.view(), ANN) == "2 visitors, you are 1: you drive"
    hall.wheel.leave(ANN)
    assert presence(hall.wheel.view(), BEN) == "1 visitor: the next to act drives"
