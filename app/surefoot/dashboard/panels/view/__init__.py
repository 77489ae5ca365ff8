"""Tab View: camera and legend."""
