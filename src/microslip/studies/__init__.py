"""What needs a scene and one solver or both: curve, sweep, verify, tables."""
