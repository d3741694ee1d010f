"""Whether both solvers agree: orbits that are found again, and sweeps that slow."""
