"""Newton's iteration and arc-length continuation; knows no physics."""
