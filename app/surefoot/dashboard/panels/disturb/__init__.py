"""Tab Disturb: pushes, pulls, stones, ground."""
