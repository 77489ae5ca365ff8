"""Only what differs is written into a widget."""

from surefoot.dashboard.ui.synced_widget import set_changed


class Handle:
    """Remembers what is written into it."""

    def __init__(self, **values):
        self.__dict__.update(values, written=[])

    def __setattr__(self, name, value):
        self.written.append((name, value))
        self.__dict__[name] = value


def test_only_what_differs_is_written():
    handle = Handle(content="as it was", visible=True, label="one")
    set_changed(handle, content="as it was", visible=False, label="two")
    assert handle.written == [("visible", False), ("label", "two")]
    set_changed(handle, content="as it was", visible=False, label="two")
    assert len(handle.written) == 2
