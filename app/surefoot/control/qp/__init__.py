"""The contact QP (17) and the solvers."""
