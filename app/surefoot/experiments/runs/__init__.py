"""One headless run: its summary, its ticks as a file, and what made it."""
