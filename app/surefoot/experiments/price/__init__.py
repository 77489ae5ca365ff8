"""The price list: what each imperfection of a robot costs, in what is survived.

Left to right: ``figures`` (what is played) x ``variants`` (imperfections, one at a time, then together) -> ``plan`` (a
bench) -> the bench's engine and store -> ``losses`` -> ``page``.
"""
