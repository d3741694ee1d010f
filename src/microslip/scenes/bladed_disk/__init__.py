"""A lumped bladed disk with friction between neighbouring blades."""
