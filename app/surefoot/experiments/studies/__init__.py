"""Several runs beside each other: grids, and every switch one at a time."""
