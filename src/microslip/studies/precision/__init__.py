"""Error against run time: methods, settings and outsiders on one periodic motion."""
