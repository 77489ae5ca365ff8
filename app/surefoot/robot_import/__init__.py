"""Robots of others: an MJCF file or a URDF and, beside it, a ``robot.toml``; read, checked and made fit for control."""
