"""Tab Export: runs, replays, pictures, links."""
