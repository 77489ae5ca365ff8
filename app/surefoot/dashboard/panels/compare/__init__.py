"""Tab A/B: settings A against B."""
