"""Rewind in a real browser: back ten seconds, on again, and the fork that saves Bip from a fall."""

import pytest

pytestmark = pytest.mark.browser


def scrub_to(screen, time_s):
    """Type into the number box of the timeline's slider."""
    screen.set_number("t [s]", time_s)
    screen.wait_for(lambda: abs(screen.dashboard.session.snapshot.time_s - time_s) < 1e-6)


def test_ten_seconds_back_and_on_are_the_same_to_the_bit(screen):
    session = screen.dashboard.session
    screen.set_number("Speed", 2)
    screen.press("outer edge")
    screen.see_event("stone 10 mm high")
    screen.press("Push now")
    screen.see_event("push 20 N s")
    screen.wait_for(lambda: session.snapshot.time_s > 10.5)
    screen.press("Play / pause")
    screen.wait_for(lambda: not session.snapshot.playing)
    once = session.snapshot
    scrub_to(screen, round(once.time_s - 10.0, 3))
    assert not session.snapshot.playing
    screen.page.get_by_text("10.000 s back").wait_for()
    screen.press("+10 ms")
    screen.page.get_by_text("9.990 s back").wait_for()
    screen.press("-1 ms")
    screen.page.get_by_text("9.991 s back").wait_for()
    screen.keep("rewind_back")

    screen.press("Play / pause")
    screen.wait_for(lambda: session.snapshot.time_s > once.time_s - 9.5)
    screen.press("Live")  # ticks the rest too, and runs on
    screen.wait_for(lambda: session.snapshot.time_s > once.time_s)
    scrub_to(screen, round(once.time_s, 3))
    assert session.snapshot.geometry.qpos.tobytes() == once.geometry.qpos.tobytes()
    assert session.snapshot.balance.torques_nm.tobytes() == once.balance.torques_nm.tobytes()


def test_a_fall_leads_back_to_its_beginning_and_another_controller_averts_it(screen):
    session = screen.dashboard.session
    screen.choose("Controller", "optimization")
    screen.press("outer edge")
    screen.see_event("paused after the fall")
    fall_s = session.snapshot.balance.fall_time_s
    screen.press("Go to 0.5 s before the fall")
    screen.wait_for(lambda: session.snapshot.time_s == pytest.approx(fall_s - 0.5, abs=1e-3))
    screen.page.get_by_text("Bip has fallen").wait_for(state="hidden")
    screen.keep("rewind_before_the_fall")

    screen.press("Live")
    screen.page.get_by_text("Bip has fallen").wait_for()
    limit_s = session.snapshot.balance.first_limit_s
    screen.press("Go to the first limit passed")
    screen.wait_for(lambda: session.snapshot.time_s == pytest.approx(limit_s, abs=1e-3))
    screen.choose("Controller", "two-part")
    screen.see_event("forked at")
    screen.press("Play / pause")
    screen.wait_for(lambda: session.snapshot.time_s > fall_s + 1.0)
    assert session.snapshot.balance.fall_cause is None
    screen.keep("rewind_forked")
