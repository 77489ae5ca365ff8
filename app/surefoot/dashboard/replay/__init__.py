"""A saved run as a page."""
