"""Where swept sines jump, beside the folds of the curve."""
