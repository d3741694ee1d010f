"""Scenes: files that are read and checked, and what their rigs are built of."""
