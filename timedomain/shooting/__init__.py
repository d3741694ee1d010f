"""Periodic orbits as fixed points of a march, and what happens beside them."""
