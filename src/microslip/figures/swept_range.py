"""What a panel shows of a curve beside sweeps: their range."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from microslip_mechanics.arrays import Array

ROOM = 1.08
"""height of the panel, over the largest deflection in it"""


def show_swept(
    axes: Axes,
    curve: tuple[Array, Array],
    sweeps: Sequence[tuple[Array, Array]],
    *,
    beside: float = 0.0,
) -> None:
    """Limit axes to the range of sweeps, and to what the lines reach there.

    Parameters
    ----------
    axes
        On which curve and sweeps are drawn.
    curve, sweeps
        Frequencies [Hz] and deflections, as drawn, the first axis being that of
        frequencies.
    beside
        How much is shown beside the sweeps, over their range.
    """
    swept = np.concatenate([hertz for hertz, _ in sweeps])
    if not swept.size:
        return
    low, high = swept.min(), swept.max()
    room = beside * (high - low)
    axes.set_xlim(low - room, high + room)
    at, peaks = curve
    inside = peaks[(at >= low - room) & (at <= high + room)]
    heights = inside, *(each for _, each in sweeps)
    highest = max(np.nanmax(each, initial=0.0) for each in heights)
    if highest > 0.0:
        axes.set_ylim(0.0, ROOM * highest)
