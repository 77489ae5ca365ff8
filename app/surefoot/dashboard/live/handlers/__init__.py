"""What each command does to the live run."""
