"""Tab Walk: a walk of one's own."""
