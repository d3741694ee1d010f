"""The harmonic balance of structure and contacts, and what solves with its Jacobian."""
