"""The simulation that obeys commands: no thread, no process, no clock."""
