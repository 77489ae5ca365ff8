"""Tab Twin: a second robot under the same disturbances."""
