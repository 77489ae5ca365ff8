"""What the user turns and reads, one folder a tab: each panel sends commands and shows snapshots."""
