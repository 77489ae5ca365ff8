"""What a person turns and reads: each panel sends commands and shows snapshots."""
