"""Damping of a structure from few numbers."""
