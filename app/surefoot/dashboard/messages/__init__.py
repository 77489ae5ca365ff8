"""All that crosses a thread or a process: commands in, snapshots out. Frozen, without behaviour."""
