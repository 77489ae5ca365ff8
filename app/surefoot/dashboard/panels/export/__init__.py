"""Tab Keep: runs, replays, pictures, links."""
