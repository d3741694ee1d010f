"""What other residual tractions would make of a curve's amplitudes, in words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from microslip_mechanics.arrays import Array
    from microslip_mechanics.results.response_curve import ResponseCurve

SEEN = 1e-3
"""relative change from which on it is told"""


def residual_range(curve: ResponseCurve) -> list[str]:
    """Return lines that say how far amplitudes are not unique; none if they are.

    What is smaller than the error of its point, or :data:`SEEN`, is not told.
    """
    import numpy as np

    points = np.arange(curve.frequency.size)
    probe = curve.amplitude.argmax(axis=1)
    amplitude, low, high = (
        each[points, probe]
        for each in (curve.amplitude, curve.amplitude_lowest, curve.amplitude_highest)
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        change = np.nan_to_num(np.stack([low, high]) / amplitude - 1.0, posinf=np.inf)
    told = np.abs(change).max(axis=0) > np.maximum(curve.error, SEEN)
    if not told.any():
        return []
    lines = [
        "not unique: contacts that stick all the time may carry other residual "
        "tractions, left by what came before; to first order these change the "
        f"amplitude at {told.sum()} of {told.size} points, by {_most(curve, change)}"
    ]
    for place, event in enumerate(curve.event):
        if event == "peak" and told[place]:
            hertz = curve.frequency[place] / math.tau
            lines.append(f"of the peak at {hertz:.6f} Hz by {_both(*change[:, place])}")
    return lines


def _most(curve: ResponseCurve, change: Array) -> str:
    """Return the largest change to both sides, and where it is."""
    sides = []
    for values, place in zip(
        change, (change[0].argmin(), change[1].argmax()), strict=True
    ):
        where = f"{curve.frequency[place] / math.tau:.4f} Hz"
        sides.append(f"{_percent(values[place])} at {where}")
    return " and ".join(sides)


def _both(low: float, high: float) -> str:
    """Return changes to both sides."""
    return f"{_percent(low)} to {_percent(high)}"


def _percent(change: float) -> str:
    """Return a relative change in percent, with its sign."""
    return f"{100.0 * change:+.2g} %" if math.isfinite(change) else "no bound"
