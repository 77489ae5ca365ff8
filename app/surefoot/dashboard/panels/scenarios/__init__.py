"""Tab Scenarios: the gallery of shipped scenarios."""
