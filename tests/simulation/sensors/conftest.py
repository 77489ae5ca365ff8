"""Estimators from a package of somebody else's."""

from collections.abc import Iterator

import pytest

from surefoot.estimation.registry import ENTRY_POINT_GROUP
from tests.support.plug_ins import installed, put_package

_HOME = "tests.support.strapdown"


@pytest.fixture(scope="module", autouse=True)
def estimators_installed(tmp_path_factory) -> Iterator[None]:
    """``strapdown``, and two that fail."""
    folder = tmp_path_factory.mktemp("estimators")
    points = {"strapdown": f"{_HOME}:STRAPDOWN", "failing": f"{_HOME}:FAILING", "gives-nan": f"{_HOME}:NAN"}
    put_package(folder, "strapdown", points, ENTRY_POINT_GROUP)
    with installed(folder):
        yield
