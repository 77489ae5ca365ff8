"""The window: a session thread that owns the simulation, commands in, snapshots out, panels and views in a browser."""
