"""What is measured while the run goes on: plot rows, limits, and the snapshot of now."""
