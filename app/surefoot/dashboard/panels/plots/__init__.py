"""Tab Plots: chosen plots, and keeping them as CSV or PNG."""
