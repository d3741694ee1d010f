"""microslip: nonlinear forced response with friction and contact."""
