"""Tab Balance: the plan of the feet, the limits, the event log."""
