"""Whole curves: first points, restarts, branches, detached curves, folds."""
