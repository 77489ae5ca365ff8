"""What the user sees in the 3D area, drawn from snapshots."""
