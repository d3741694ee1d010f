"""Linear structures: beams, bodies, frames, rotation, damping, and their modes."""
