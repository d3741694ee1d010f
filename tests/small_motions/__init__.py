"""Small motions marched around an orbit: multipliers without harmonic balance."""
