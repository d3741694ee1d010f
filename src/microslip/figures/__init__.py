"""Pictures of results; each function draws on a figure that it makes or axes it is given."""
