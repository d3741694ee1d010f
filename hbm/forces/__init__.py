"""Contact forces over one period, their tangents and their Fourier series."""
