"""How fast an error falls under refinement."""

from collections.abc import Sequence
from typing import SupportsFloat

import numpy as np


def observed_order(
    step_sizes: Sequence[float], errors: Sequence[SupportsFloat]
) -> float:
    """Return the slope of log(error) over log(step size), fitted by least squares."""
    slope, _ = np.polyfit(np.log(step_sizes), np.log([float(e) for e in errors]), 1)
    return float(slope)
