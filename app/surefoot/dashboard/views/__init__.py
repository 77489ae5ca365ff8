"""What a person sees in the 3D area, drawn from snapshots."""
