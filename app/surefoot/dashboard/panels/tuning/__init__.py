"""Tabs Gains and Equations: gains, equation switches, presets, undo."""
