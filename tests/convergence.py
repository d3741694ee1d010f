"""How fast an error falls under refinement."""

from collections.abc import Sequence

import numpy as np


def observed_order(step_sizes: Sequence[float], errors: Sequence[float]) -> float:
    """Return the slope of log(error) over log(step size), fitted by least squares."""
    slope, _ = np.polyfit(np.log(step_sizes), np.log(errors), 1)
    return float(slope)
