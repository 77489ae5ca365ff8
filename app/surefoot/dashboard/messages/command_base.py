"""What the history has to know of a command."""


class WorldCommand:
    """Mark of every command that disturbs: it is remembered with its tick, and comes again after a fork."""


class ControlCommand:
    """Mark of every command about controller and settings: remembered with its tick, forgotten by an earlier fork."""
