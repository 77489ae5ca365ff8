"""The lab: how far a controller gets in each family of disturbances, measured against what physics allows.

One bench, left to right: ``families`` (cases of growing intensity) x ``contestants`` x ``variations`` (seeds) ->
``plan`` (cells) -> ``engine`` or ``cluster`` (somewhere) -> ``probe`` (one cell: search over levels, each level one
episode, judged) -> ``store`` (append-only) -> one table -> ``ranking``.
"""
