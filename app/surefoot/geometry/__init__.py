"""Rotations, small vectors and convex polygons. NumPy only; knows nothing of robots."""
