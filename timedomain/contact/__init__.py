"""Contact forces within one step, with their derivatives, compiled."""
