"""An equation's owner is no ornament: it runs on the control path or in an ablation, or a law test calls it."""

import sys
from pathlib import Path

from surefoot.equation_ledger import owners

LAW_TESTS = Path(__file__).parent / "laws"
RUNS = [
    ("two-part", {}),
    ("optimization", {}),
    ("soft-qp", {}),
    ("two-part-literal", {}),
    ("two-part", {"delta_form": "printed"}),
    ("two-part", {"delta_source": "gravity", "other_joints": "inverse-dynamics"}),
    ("two-part", {"p_point": "offset", "tangential_term": False, "delta_ref_frontal_nm": 10.0}),
    ("two-part", {"feedforward": "planned"}),
]
SWING = {"kind": "swing", "amplitude_m": 0.01, "duration_s": 0.6, "start_s": 0.0}


def names_run(simulate) -> set[str]:
    """Qualified names of everything called in a few ticks of every controller, building included."""
    called = set()

    def note(frame, event, argument):
        if event == "call":
            called.add(f"{frame.f_globals.get('__name__')}.{frame.f_code.co_qualname}")

    for controller, settings in RUNS:
        before = sys.getprofile()
        sys.setprofile(note)
        try:
            simulation = simulate(controller, controller=settings, support="double", reference=SWING)
            for _ in range(3):
                simulation.tick()
        finally:
            sys.setprofile(before)
    return called


def test_every_owner_is_called(simulate):
    called = names_run(simulate)
    laws = "\n".join(path.read_text(encoding="utf-8") for path in LAW_TESTS.glob("*.py"))
    idle = {
        owner.qualified_name
        for claims in owners().values()
        for owner in claims
        if owner.qualified_name not in called and f"{owner.qualified_name.rsplit('.', 1)[-1]}(" not in laws
    }
    assert not idle, f"owned on paper only: {sorted(idle)}"


def test_a_function_that_nobody_calls_would_be_found(simulate):
    assert "surefoot.control.balance.ankle_law.torques_point_at_ankle" in names_run(simulate)
    assert "surefoot.control.balance.ankle_law.no_such_law" not in names_run(simulate)
