"""The bench: how far a controller gets in each family of disturbances, measured against what physics allows.

Left to right: ``families`` (cases of growing intensity) x ``entries`` (controllers) x ``variations`` (seeds)
-> ``cells`` -> ``engine`` (somewhere) -> ``cell_runner`` (one cell: search over levels, each level one
episode, judged) -> ``store`` (one file a cell) -> one table -> ``ranking``.
"""
