"""Scenes of kind ``system``: any structure, any elements; the built-in ones beside."""
