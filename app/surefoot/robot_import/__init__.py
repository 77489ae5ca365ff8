"""Robots of others: an MJCF file and, beside it, a ``robot.toml``; read, checked and made fit for the controllers."""
