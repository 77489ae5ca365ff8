"""Shared by panels and scene: colours, symbols, widgets that follow a snapshot, texts."""
