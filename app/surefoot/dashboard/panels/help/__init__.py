"""Tab Help: the guide, the keys, the tour."""
