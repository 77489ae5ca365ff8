"""The contact QP (17) and the door to the solvers."""
