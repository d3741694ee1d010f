"""Ground floor of microslip: structures, contact laws and what solvers are given."""
