"""The tab Sensors."""
