"""Loads in space and over time, as a user gives them and as a march takes them."""
