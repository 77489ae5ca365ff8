"""Linear algebra runs on one thread, and a caller's own setting comes back."""

import numpy  # noqa: F401  (its library is one of those that are looked at)
from threadpoolctl import threadpool_info, threadpool_limits

from surefoot import api
from surefoot.blas_threads import one_blas_thread


def threads() -> set[int]:
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


def test_these_tests_run_on_one_thread():
    assert threads() == {1}


def test_the_callers_setting_comes_back():
    with threadpool_limits(2, user_api="blas"):
        before = threads()
        with one_blas_thread():
            assert threads() == {1}
        assert threads() == before


def test_a_run_from_python_is_on_one_thread(monkeypatch):
    seen = []

    def simulate(*arguments, **more):
        seen.append(threads())
        return original(*arguments, **more)

    original = api.simulate
    monkeypatch.setattr(api, "simulate", simulate)
    with threadpool_limits(2, user_api="blas"):
        api.run("stand_left", changes={"duration_s": 0.01})
    assert seen == [{1}]
