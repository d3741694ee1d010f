"""Contact: one law per file, one table of points, one compiled force."""
