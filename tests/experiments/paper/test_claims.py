"""Verdicts follow from the runs: other runs, other verdicts, and nobody types one."""

import inspect

import pytest

from surefoot.experiments.paper import claims_on_balance, claims_on_steps, claims_on_the_law
from surefoot.experiments.paper.claims import Check, Claim, ClaimVerdict, judge
from surefoot.experiments.paper.make_report import CLAIMS
from surefoot.experiments.paper.plan import STONE

YES, NO = Check(True, "it does"), Check(False, "it does not")


@pytest.mark.parametrize(
    ("checks", "universal", "verdict"),
    [
        ([YES, YES], False, ClaimVerdict.REPRODUCED),
        ([YES, NO], False, ClaimVerdict.PARTLY),
        ([NO, NO], False, ClaimVerdict.NOT),
        ([YES, NO], True, ClaimVerdict.NOT),
        ([YES, YES], True, ClaimVerdict.REPRODUCED),
    ],
)
def test_verdict_follows_from_the_checks(checks, universal, verdict, invented_findings):
    claim = Claim("a claim", "somewhere", "a figure", lambda f: checks, universal=universal)
    (judgement,) = judge([claim], invented_findings(lambda case: False))
    assert judgement.verdict is verdict


def test_what_was_put_in_is_never_called_reproduced(invented_findings):
    claim = Claim("a time", "somewhere", "a figure", lambda f: [YES], put_in=True)
    assert judge([claim], invented_findings(lambda case: False))[0].verdict is ClaimVerdict.CALIBRATED
    about_the_time = [claim for claim in CLAIMS if "0.92" in claim.text]
    assert about_the_time
    assert all(claim.put_in for claim in about_the_time)


def test_a_claim_without_a_check_is_refused(invented_findings):
    with pytest.raises(ValueError, match="no check"):
        judge([Claim("empty", "nowhere", "nothing", lambda f: [])], invented_findings(lambda case: False))


def verdicts(findings):
    return {judgement.claim.text: judgement.verdict for judgement in judge(CLAIMS, findings)}


def test_verdicts_change_with_the_runs(invented_findings):
    nobody_falls = verdicts(invented_findings(lambda case: False))
    all_fall = verdicts(invented_findings(lambda case: True, margin=-0.01))
    as_the_paper_has_it = verdicts(invented_findings(lambda case: case.controller in ("optimization", "soft-qp")))

    falls = "Under optimization the robot falls"
    assert nobody_falls[falls] is ClaimVerdict.NOT
    assert all_fall[falls] is as_the_paper_has_it[falls] is ClaimVerdict.REPRODUCED
    unlimited = "The unlimited law (28) keeps the ZMP inside the sole"
    assert nobody_falls[unlimited] is as_the_paper_has_it[unlimited] is ClaimVerdict.REPRODUCED
    assert all_fall[unlimited] is ClaimVerdict.NOT
    inevitable = "Without the technique that fall is inevitable"
    assert as_the_paper_has_it[inevitable] is ClaimVerdict.REPRODUCED
    assert nobody_falls[inevitable] is ClaimVerdict.NOT


def test_one_gain_set_that_stands_refutes_inevitable(invented_findings):
    soft = next(case for case in invented_findings(lambda case: False).plan.sweep if case.scenario == STONE
                and case.controller == "optimization" and "latched" not in case.row)  # fmt: skip
    found = verdicts(invented_findings(lambda case: case.controller != "two-part" and case != soft))
    assert found["Without the technique that fall is inevitable"] is ClaimVerdict.NOT


def test_no_verdict_is_typed_beside_a_claim():
    for module in (claims_on_balance, claims_on_steps, claims_on_the_law):
        source = inspect.getsource(module)
        assert "Verdict" not in source
        assert "partly" not in source.lower()


def test_every_claim_says_where_the_paper_and_where_we_show_it():
    for claim in CLAIMS:
        assert claim.text
        assert claim.source
        assert claim.evidence
