"""Linear and nonlinear modes: free decaying motions."""
