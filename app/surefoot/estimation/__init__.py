"""From what the sensors say to the state that a controller believes."""
