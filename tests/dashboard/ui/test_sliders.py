"""Number boxes hold what scenarios may hold, and more digits than their sliders' steps."""

from dataclasses import fields

import pytest
import viser

from surefoot.dashboard.launch import start_dashboard
from surefoot.simulation.physics import PhysicsSettings


@pytest.mark.parametrize(("kind", "least"), [(viser.GuiSliderHandle, 20), (viser.GuiNumberHandle, 5)])
def test_every_number_of_the_page_takes_fractions(dashboard, kind, least):
    """Viser would round to the digits of the step, and keep whole what began as a whole number."""
    handles = [h for h in dashboard.server.gui._gui_input_handle_from_uuid.values() if isinstance(h, kind)]
    assert len(handles) >= least
    for handle in handles:
        assert isinstance(handle.value, float) and handle.precision >= 6, handle.label


@pytest.mark.parametrize("bound", ["low", "high"])
@pytest.mark.parametrize(
    "field", [f for f in fields(PhysicsSettings) if f.metadata["kind"] == "number"], ids=lambda f: f.name
)
def test_a_scenario_at_the_end_of_what_physics_takes_opens(tmp_path, field, bound):
    file = tmp_path / "edge.toml"
    file.write_text(
        f'robot = "bip"\nsupport = "left"\nduration_s = 1.0\n[physics]\n{field.name} = {field.metadata[bound]}\n'
    )
    running = start_dashboard(port=0, scenario=str(file), processes=False)
    try:
        assert running.session.snapshot.scenario == "edge"
        friction = running.session.snapshot.friction
        assert friction == (field.metadata[bound] if field.name == "friction" else PhysicsSettings().friction)
    finally:
        running.stop()
