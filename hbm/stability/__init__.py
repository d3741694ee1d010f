"""Floquet multipliers of one periodic response."""
