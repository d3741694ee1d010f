"""Harmonics and samples by the error that they leave."""
