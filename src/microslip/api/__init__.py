"""The functions of plain Python, for scripts and notebooks."""
