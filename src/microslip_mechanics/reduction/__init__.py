"""Large structures in few coordinates, with what that leaves out."""
