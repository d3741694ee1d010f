"""The equations in first-order form, for solvers from elsewhere."""
