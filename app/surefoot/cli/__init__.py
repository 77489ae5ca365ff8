"""The command line: one module a command, flags in ``main``."""
