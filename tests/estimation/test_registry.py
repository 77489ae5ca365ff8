"""Estimators by name: ours, those that an installed package brings, and clear words about all others."""

import pytest

from surefoot.errors import InvalidInput
from surefoot.estimation.registry import (
    ENTRY_POINT_GROUP,
    TRUTH,
    estimator_named,
    estimators,
    unavailable_estimators,
)
from surefoot.estimation.settings import EstimatorSettings
from tests.support.plug_ins import installed, put_package

_HOME = "tests.support.strapdown"
UNUSABLE = {
    "absent": r"cannot be loaded \(AttributeError: .*ABSENT",
    "no-entry": "is no EstimatorEntry but a str",
    "thief": "the name 'truth', which another estimator has",
    "buildless": "a build that cannot be called",
}


def test_the_truth_needs_no_estimator():
    assert estimator_named(TRUTH).build is None
    assert next(iter(estimators())) == TRUTH
    assert EstimatorSettings().kind == TRUTH


def test_a_package_brings_estimators_and_those_that_cannot_be_used_say_why(tmp_path):
    points = {
        "strapdown": "STRAPDOWN",
        "absent": "ABSENT",
        "no-entry": "NO_ENTRY",
        "thief": "THIEF",
        "buildless": "BUILDLESS",
    }
    put_package(tmp_path, "strapdown", {name: f"{_HOME}:{place}" for name, place in points.items()}, ENTRY_POINT_GROUP)
    before = list(estimators())
    with installed(tmp_path):
        assert list(estimators()) == [*before, "strapdown"]
        assert EstimatorSettings(kind="strapdown").kind == "strapdown"
        assert estimator_named(TRUTH).build is None
        assert set(unavailable_estimators()) == set(UNUSABLE)
        for name, reason in UNUSABLE.items():
            with pytest.raises(InvalidInput, match=reason):
                estimator_named(name)
    assert list(estimators()) == before


@pytest.mark.parametrize("kind", ["splendid", "", None, 3, [1]])
def test_an_unknown_one_is_refused_with_those_there_are(kind):
    with pytest.raises(InvalidInput, match=r"estimator\.kind.*no such estimator.*truth"):
        EstimatorSettings(kind=kind)
