"""What solvers return, and what is read from it."""
