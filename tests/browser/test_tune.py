"""Tuning as a person does it: drag, undo, store A and B, switch, run them as twins, take a preset, bring a bad file."""

import pytest

pytestmark = pytest.mark.browser


HOLD = """async (thumb, steps) => {
  for (let i = 0; i < steps; i++) {
    thumb.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', bubbles: true}));
    await new Promise(done => setTimeout(done, 60));
  }
}"""


def hold_key(screen, label: str, steps: int) -> None:
    """Move a slider by its arrow key, held down: pressed from here one by one, a slow page would be many drags."""
    row = screen.page.locator("label:visible", has_text=label).first
    thumb = row.locator("xpath=ancestor::*[.//*[@role='slider']][1]").get_by_role("slider").first
    thumb.evaluate(HOLD, steps)


def test_tuning(screen):
    page, session = screen.page, screen.dashboard.session

    def settings():
        return session.snapshot.settings

    def said(label):
        return page.get_by_label(label, exact=True).locator("visible=true").inner_text()

    screen.tab("Gains")
    page.get_by_text("All settings are the defaults of two-part").locator("visible=true").wait_for()
    assert page.get_by_role("button", name="Nothing to undo", exact=True).first.is_disabled()
    screen.set_number("CoM K_P", 90)
    page.get_by_role("button", name="Undo: CoM K_P 60 → 90", exact=True).wait_for()
    screen.wait_for(lambda: said("Changed settings") == "1 setting differs from the defaults: CoM K_P 60 → 90")
    hold_key(screen, "Trunk K_P", 6)
    page.get_by_role("button", name="Undo: Trunk K_P 60 → 66", exact=True).wait_for()
    assert session.snapshot.tuning.steps == 2
    page.keyboard.press("Control+z")
    screen.wait_for(lambda: settings().pelvis_stiffness == 60.0)
    screen.press("Undo: CoM K_P 60 → 90")
    screen.wait_for(lambda: settings().com_stiffness == 60.0)
    screen.press("Redo: CoM K_P 60 → 90")
    screen.wait_for(lambda: settings().com_stiffness == 90.0)
    page.get_by_role("button", name="Redo: Trunk K_P 60 → 66", exact=True).wait_for()

    screen.tab("A/B")
    assert page.get_by_role("button", name="Run A against B as twins", exact=True).is_disabled()
    screen.press("A")
    page.get_by_text("A is at work; change something").wait_for()
    screen.set_number("ZMP margin", 0.8)
    screen.wait_for(lambda: settings().zmp_margin == 0.8)
    screen.choose("Controller", "soft-qp")
    screen.wait_for(lambda: session.snapshot.controller == "soft-qp")
    screen.press("B")
    screen.wait_for(lambda: "at work: B" in said("Settings A and B"))
    rows = [line.split() for line in said("Settings A and B").splitlines()]
    assert ["Controller", "two-part", "soft-qp"] in rows
    assert ["ZMP", "margin", "[-]", "0.95", "0.8"] in rows
    assert not any(row[:2] == ["CoM", "K_P"] for row in rows)
    screen.press("Switch to A")
    screen.wait_for(lambda: (session.snapshot.controller, settings().zmp_margin) == ("two-part", 0.95))
    page.get_by_role("button", name="Switch to B", exact=True).wait_for()
    page.keyboard.press("x")
    screen.wait_for(lambda: (session.snapshot.controller, settings().zmp_margin) == ("soft-qp", 0.8))
    screen.keep("tune_a_b")

    screen.press("Run A against B as twins")
    screen.wait_for(lambda: session.snapshot.twin is not None and session.snapshot.twin.other is not None)
    screen.wait_for(lambda: session.snapshot.controller == "two-part")
    twin = session.snapshot.twin.other
    assert (twin.controller, twin.settings.zmp_margin, twin.settings.com_stiffness) == ("soft-qp", 0.8, 90.0)
    assert (settings().zmp_margin, settings().com_stiffness) == (0.95, 90.0)

    page.get_by_role("button", name="Presets and files").or_(page.get_by_text("Presets and files")).first.click()
    screen.choose("Preset", "com_stiff")
    page.get_by_text("CoM K_P 60 → 100 1/s²").locator("visible=true").wait_for()
    screen.press("Use this preset")
    screen.wait_for(lambda: (settings().com_stiffness, settings().com_damping) == (100.0, 20.0))
    page.get_by_text("at work now").wait_for()
    screen.wait_for(lambda: said("Changed settings").startswith("2 settings differ from the defaults"))
    screen.keep("tune_preset")

    bad = {"name": "bad.toml", "mimeType": "application/toml", "buffer": b"[controller]\ncom_stifness = 3.0\n"}
    with page.expect_file_chooser() as chooser:
        screen.press("Load settings")
    chooser.value.set_files([bad])
    page.get_by_text("unknown setting (valid: com_stiffness").wait_for()
    assert settings().com_stiffness == 100.0


def step_back(screen) -> None:
    session = screen.dashboard.session
    before = session.snapshot.time_s
    screen.press("◀ event before")
    screen.wait_for(lambda: session.snapshot.time_s < before - 1e-6)


def test_a_stone_is_seen_under_the_foot_and_found_again(screen):
    page, session = screen.page, screen.dashboard.session
    screen.press("outer edge")
    screen.see_event("stone 10 mm high")
    page.locator("[data-stone='0']").wait_for(state="attached")
    placed = next(event.time_s for event in session.snapshot.events if event.kind == "stone")
    screen.wait_for(lambda: session.snapshot.time_s > placed + 0.5)
    screen.press("Play / pause")
    screen.wait_for(lambda: not session.snapshot.playing)
    screen.keep("tune_stone")
    for _ in range(10):
        if session.snapshot.time_s < placed + 1e-6:
            break
        step_back(screen)
    assert session.snapshot.time_s == pytest.approx(placed)
    if any(mark.time_s > placed + 0.01 for mark in session.snapshot.timeline.marks):
        page.keyboard.press("k")
        screen.wait_for(lambda: session.snapshot.time_s > placed + 1e-6)
