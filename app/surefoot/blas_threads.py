"""Linear algebra on one thread: the matrices are 21 x 21 to some 60 x 60, more threads only wait for each other.

Seen on two shared cores: four seconds of a walk took 23 s with two threads and 5 s with one.
"""

from contextlib import AbstractContextManager

from threadpoolctl import threadpool_limits

# For the environment of a program of ours, before it imports NumPy
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def one_blas_thread() -> AbstractContextManager[object]:
    """For a piece of somebody else's program, who may have imported NumPy before; afterwards all is as it was."""
    return threadpool_limits(limits=1, user_api="blas")
