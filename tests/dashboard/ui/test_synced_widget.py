"""A widget follows the session, but is never taken out of a person's hand."""

from surefoot.dashboard.ui.synced_widget import Shared, SyncedWidget


class Widget:
    """A widget as viser has them."""

    def __init__(self, value):
        self._value, self.written = value, 0

    @property
    def value(self):
        return self._value

    @value.setter
    def value(self, value):
        self._value, self.written = value, self.written + 1

    def moved_by_a_person(self, value):
        self._value = value


def test_the_session_is_followed():
    widget = Widget(1.0)
    follower = SyncedWidget(widget)
    follower.show(2.0)
    assert widget.value == 2.0
    follower.show(2.0 + 1e-12)
    assert widget.written == 1


def test_a_change_that_is_not_yet_obeyed_is_left_alone():
    widget = Widget("soft-qp")
    follower = SyncedWidget(widget)
    widget.moved_by_a_person("two-part")
    for _ in range(3):
        follower.show("soft-qp")  # not yet obeyed
    assert widget.value == "two-part"
    follower.show("two-part")
    follower.show("optimization")  # somebody else's change comes at once
    assert widget.value == "optimization"


def test_a_change_that_is_refused_is_taken_back():
    widget = Widget(10.0)
    follower = SyncedWidget(widget)
    widget.moved_by_a_person(99.0)
    for _ in range(40):
        follower.show(10.0)
    assert widget.value == 10.0
    assert widget.written == 1


def test_a_change_that_comes_between_asking_and_writing_is_not_lost():
    widget = Widget(1.0)
    shared = Shared(widget)
    assert not shared.changed()
    widget.moved_by_a_person(5.0)
    shared.put(2.0)
    assert (widget.value, widget.written) == (5.0, 0)
    assert shared.changed()
    shared.put(2.0)  # seen, and no longer wanted
    assert widget.value == 2.0
