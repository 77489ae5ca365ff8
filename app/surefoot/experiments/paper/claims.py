"""A claim of the paper, the checks it is broken into, and the verdict that follows from them."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import StrEnum

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.runs.cases import CaseResult


class ClaimVerdict(StrEnum):
    """How a claim fared; never typed, always computed from its checks."""

    REPRODUCED = "reproduced"
    CALIBRATED = "calibrated"
    PARTLY = "partly"
    NOT = "not reproduced"


@dataclass(frozen=True)
class Check:
    """One thing a claim would have to be true for.

    Attributes:
        holds: whether the runs show it.
        text: what they show, with numbers.
    """

    holds: bool
    text: str


@dataclass(frozen=True)
class Claim:
    """Something the paper says.

    Attributes:
        text: the claim, in our words.
        source: where the paper says it.
        evidence: our figure or table.
        checks: reads them out of the findings.
        universal: it is said of every case ("assured", "inevitable"): one counterexample refutes it.
        put_in: the scenario was calibrated to it: that it comes out again is no evidence.
    """

    text: str
    source: str
    evidence: str
    checks: Callable[[Findings], list[Check]]
    universal: bool = False
    put_in: bool = False


@dataclass(frozen=True)
class Judgement:
    """A claim with its checks and verdict."""

    claim: Claim
    checks: tuple[Check, ...]

    @property
    def verdict(self) -> ClaimVerdict:
        """All checks hold, some do, or none (for a universal claim: all or not)."""
        holding = [check.holds for check in self.checks]
        if all(holding):
            return ClaimVerdict.CALIBRATED if self.claim.put_in else ClaimVerdict.REPRODUCED
        return ClaimVerdict.PARTLY if any(holding) and not self.claim.universal else ClaimVerdict.NOT


def judge(claims: Iterable[Claim], findings: Findings) -> tuple[Judgement, ...]:
    """The verdict on every claim. Raises ValueError for a claim without a check."""
    judged = tuple(Judgement(claim, tuple(claim.checks(findings))) for claim in claims)
    for judgement in judged:
        if not judgement.checks:
            raise ValueError(f"{judgement.claim.text!r} has no check")
    return judged


def outcome(result: CaseResult) -> str:
    """``stands`` or ``falls at 1.410 s``."""
    return f"falls at {result.summary['fall_time_s']:.3f} s" if result.fell else "stands"


def stands(name: str, result: CaseResult) -> Check:
    """Holds when the robot stands."""
    return Check(not result.fell, f"{name} {outcome(result)}")


def falls(name: str, result: CaseResult) -> Check:
    """Holds when the robot falls."""
    return Check(result.fell, f"{name} {outcome(result)}")


def zmp_inside(name: str, result: CaseResult) -> Check:
    """Holds when the measured ZMP never reaches the edge of the sole."""
    margin = result.summary["zmp_margin_min_m"]
    return Check(margin > 0.0, f"{name}: least ZMP margin {1e3 * margin:+.2f} mm, {outcome(result)}")
