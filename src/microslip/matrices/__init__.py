"""Mass, damping and stiffness from files of other programs."""
