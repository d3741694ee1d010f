"""Stiff and extreme scenes by both solvers, each within its time."""
