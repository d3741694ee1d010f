"""What a curve is followed along: the frequency, or a parameter of the problem."""
