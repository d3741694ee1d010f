"""What other residual tractions would make of a curve's amplitudes, in words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import hertz

if TYPE_CHECKING:
    from microslip_mechanics.results.response_curve import ResponseCurve

SEEN = 1e-3
"""relative change from which on it is told"""


def residual_range(curve: ResponseCurve) -> list[str]:
    """Return lines that say how far amplitudes are not unique; none if they are."""
    import numpy as np

    points = np.arange(curve.frequency.size)
    probe = curve.amplitude.argmax(axis=1)
    amplitude, low, high = (
        each[points, probe]
        for each in (curve.amplitude, curve.amplitude_lowest, curve.amplitude_highest)
    )
    unknown = np.isnan(low)
    with np.errstate(divide="ignore", invalid="ignore"):
        change = np.nan_to_num(np.stack([low, high]) / amplitude - 1.0)
    told, lines = np.abs(change).max(axis=0) > SEEN, []
    if unknown.any():
        lines = [
            f"other residual tractions: not sought at {unknown.sum()} of "
            f"{unknown.size} points, where no response was found with 15 harmonics"
        ]
    if not told.any():
        return lines
    lines = [
        *lines,
        "not unique: contacts that stick all the time may carry other residual "
        "tractions, left by what came before; with such the amplitude is another one "
        f"at {told.sum()} of {told.size} points, by up to "
        + " and ".join(
            f"{_percent(values[place])} at {_place(curve, int(place))}"
            for values, place in zip(
                change, (change[0].argmin(), change[1].argmax()), strict=True
            )
            if abs(values[place]) > SEEN
        ),
    ]
    top = int(np.nanargmax(high))
    if high[top] > (1.0 + SEEN) * amplitude.max():
        lines.append(
            f"largest amplitude that was found: {1e3 * high[top]:.6g} mm at "
            f"{_place(curve, top)}, in place of {1e3 * amplitude.max():.6g} mm"
        )
    return lines


def _percent(change: float) -> str:
    """Return a relative change in percent, to three digits or whole."""
    percent = 100.0 * change
    return f"{percent:+.3g} %" if abs(percent) < 100.0 else f"{percent:+.0f} %"


def _place(curve: ResponseCurve, point: int) -> str:
    """Return where a point is."""
    if curve.along:
        return f"{curve.parameter[point]:.6g}"
    seen = curve.frequency / math.tau
    return f"{hertz(seen[point], seen)} Hz"
