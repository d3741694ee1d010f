"""Harmonic balance: periodic responses and frequency response curves."""
